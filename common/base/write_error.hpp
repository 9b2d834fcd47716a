#pragma once

#include <filesystem>

#include "common/base/error.hpp"

namespace tether {

/// What to throw where a file cannot be written: it names the file, and why if that can be seen: its disk is full, or
/// its folder is gone.
RunError write_error(const std::filesystem::path& file);

}  // namespace tether
