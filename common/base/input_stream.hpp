#pragma once

#include <filesystem>
#include <fstream>

namespace tether {

/// A file of the person's, to be read. Throws InputError for what is not there, is no file (a folder, a device, which
/// may have no end), or cannot be opened.
std::ifstream input_stream(const std::filesystem::path& file, std::ios::openmode mode = std::ios::in);

}  // namespace tether
