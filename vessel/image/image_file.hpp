#pragma once

#include <filesystem>

#include "vessel/image/image_volume.hpp"

namespace tether {

/// An image of a file (.mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz) whose lengths are `cm` centimetres each: the header's
/// origin, spacing and directions are kept. Throws InputError for a file that is cut short, has not three dimensions or
/// not one value a voxel, whose axes are not at right angles, or with values that are not finite.
ImageVolume read_image(const std::filesystem::path& file, double cm);

/// Writes it in millimetres, compressed. With `whole`, values are rounded to 16 bits. Throws InputError if the ending
/// is none of those above, RunError if it cannot be written.
void write_image(const std::filesystem::path& file, const ImageVolume& image, bool whole = false);

}  // namespace tether
