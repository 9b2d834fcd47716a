#pragma once

#include <cstdint>
#include <filesystem>

namespace tether {

/// Throws InputError if the file of an image, or the file of voxels that it names, is shorter than its `bytes` of
/// voxels take or its header says. ITK's readers of .mha and .nii fill what is not there with anything, and say
/// nothing.
void check_length(const std::filesystem::path& file, std::uint64_t bytes);

}  // namespace tether
