#pragma once

#include <filesystem>
#include <string_view>

namespace tether {

/// Writes a file so that whoever reads it finds the old one or the new one whole, also after a kill in between: beside
/// its place ("FILE.part"), then renamed. Throws RunError as write_error says; nothing is left beside then.
void write_whole(const std::filesystem::path& file, std::string_view bytes);

/// Puts a file or folder, as a whole, in the place of another. Throws RunError as write_error says.
void put_in_place(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace tether
