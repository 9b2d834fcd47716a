#pragma once

#include <vector>

#include "vessel/image/image_volume.hpp"

namespace tether {

/// What belongs to neighbours rather than to the lumen: 1, elsewhere 0. From the seeds of both, voxels are taken in the
/// order of how much values change on the way to them, so that the two meet where that is most (Meyer and Beucher
/// 1990).
ImageVolume neighbours_basin(const ImageVolume& gradient, const std::vector<std::size_t>& seeds,
                             const std::vector<std::size_t>& neighbours);

}  // namespace tether
