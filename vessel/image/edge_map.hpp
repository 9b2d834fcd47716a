#pragma once

#include "vessel/image/image_volume.hpp"

namespace tether {

/// How fast values change, by central differences; one-sided at the border [per cm]. All sides of a voxel count as its
/// shortest: blur and smoothing are as many voxels along each axis, and an edge is then as steep whichever way it
/// faces.
ImageVolume gradient_magnitude(const ImageVolume& image);

/// What rays from the seeds find at the lumen's wall: lower quartiles over the rays, since the wall that a front must
/// not miss is that toward soft tissue, not that toward air or bone.
struct WallSeen {
  double edge = 0;                    ///< change of grey values [per cm]; 0: none was found
  double contrast = 0;                ///< lumen minus surroundings, as a size
  double darkest = 0, brightest = 0;  ///< of the seeds' values
};
WallSeen wall_around(const ImageVolume& image, const ImageVolume& gradient, const std::vector<std::size_t>& seeds);

/// Values that differ from the seeds' by more than 1.5 of the contrast become those: behind a thin wall air or bone
/// would draw the edge to itself.
void clamp_values(ImageVolume& image, const WallSeen& wall);

/// What hangs together with the seeds, where values change by less than half of the wall's edge and differ from the
/// seeds' by less than half of the contrast: 1, elsewhere 0. Not where `barred`.
std::vector<char> flooded(const ImageVolume& image, const ImageVolume& gradient, const WallSeen& wall,
                          const std::vector<std::size_t>& seeds, const std::vector<char>& barred);

}  // namespace tether
