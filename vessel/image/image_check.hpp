#pragma once

#include <filesystem>

namespace tether {

/// Throws InputError unless the header of an image is one that ITK's readers may be given, and the file, or the file of
/// voxels that it names, as long as it says. They write past their arrays where a header has more dimensions or longer
/// words than they expect, take memory for what is stated, fill what is not there with anything, and say nothing.
void check_image(const std::filesystem::path& file);

}  // namespace tether
