#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace tether {

inline constexpr std::uintmax_t any_size = UINTMAX_MAX;

/// A file of the person's, to be read, of at most so many bytes. Throws InputError for what is not there, is no file (a
/// folder, a device, which may have no end), or cannot be opened.
std::ifstream input_stream(const std::filesystem::path& file, std::ios::openmode mode = std::ios::in,
                           std::uintmax_t most = any_size);

/// All that such a file holds.
std::string content_of(const std::filesystem::path& file, std::uintmax_t most = any_size);

}  // namespace tether
