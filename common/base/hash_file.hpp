#pragma once

#include <filesystem>

#include "common/base/checked_file.hpp"

namespace tether {

/// `hash_bytes` of what a file holds; `seed` if it is no regular file.
std::uint64_t hash_file(const std::filesystem::path& path, std::uint64_t seed);

}  // namespace tether
