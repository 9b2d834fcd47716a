#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vessel/image/image_volume.hpp"

namespace tether {

/// An image of a file (.mha, .mhd, .nrrd, .nhdr, .nii, .nii.gz) whose lengths are `cm` centimetres each: the header's
/// origin, spacing and directions are kept. Throws InputError for a file that is cut short, has not three dimensions or
/// not one value a voxel, whose axes are not at right angles, or with values that are not finite.
ImageVolume read_image(const std::filesystem::path& file, double cm);

/// 1 where a voxel of a .seg.nrrd is in one of the segments of these names, 0 elsewhere; segments may overlap. `field`:
/// of the study, for messages. Throws InputError as above, and for a name that is not there.
ImageVolume read_segments(const std::filesystem::path& file, double cm, const std::vector<std::string>& names,
                          const std::string& field);

/// Writes it in millimetres, compressed. With `whole`, values are rounded to 16 bits. Throws InputError if the ending
/// is none of those above, RunError if it cannot be written.
void write_image(const std::filesystem::path& file, const ImageVolume& image, bool whole = false);

}  // namespace tether
