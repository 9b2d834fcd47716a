#pragma once

#include "vessel/image/image_volume.hpp"

namespace tether {

/// Smooths along each axis by `2 G - G G` (M.20), G a Gaussian of that deviation [voxels], without moving a curved
/// surface by its curvature. Beyond the image's border it goes on as at the border. 0: as it is.
void smooth_field(ImageVolume& field, double deviation);

/// The least that leaves of noise of a tenth of the contrast a surface smooth to a tenth of a voxel [voxels].
inline constexpr double smoothing_of_grey = 0.7;

}  // namespace tether
