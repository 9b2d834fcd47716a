#pragma once

#include <vector>

#include "vessel/image/image_volume.hpp"

namespace tether {

/// Moves a front to where the image is half way between what lies on its two sides, by at most a voxel: curvature no
/// longer narrows the lumen (M.22). Of a front half a voxel off a tenth is left. Not where `kept`, and not where the
/// sides differ by half of the wall's contrast or less.
/// field: positive in the lumen, near the front the distance from it in voxels, whatever their sides.
/// contrast, edge: of the wall, as values and as their change over the shortest side of a voxel [per cm].
void move_half_way(ImageVolume& field, const ImageVolume& image, const std::vector<char>& kept, double contrast,
                   double edge);

}  // namespace tether
