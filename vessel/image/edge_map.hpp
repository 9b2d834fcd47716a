#pragma once

#include "vessel/image/image_volume.hpp"

namespace tether {

/// How fast values change, by central differences; one-sided at the border [per cm].
ImageVolume gradient_magnitude(const ImageVolume& image);

/// What rays from the seeds find at the lumen's wall: medians over the rays.
struct WallSeen {
  double edge = 0;                    ///< change of grey values [per cm]; 0: none was found
  double contrast = 0;                ///< lumen minus surroundings, as a size
  double darkest = 0, brightest = 0;  ///< of the seeds' values
};
WallSeen wall_around(const ImageVolume& image, const ImageVolume& gradient, const std::vector<std::size_t>& seeds);

/// What hangs together with the seeds, where values change by less than half of the wall's edge and differ from the
/// seeds' by less than half of the contrast: 1, elsewhere 0.
std::vector<char> flooded(const ImageVolume& image, const ImageVolume& gradient, const WallSeen& wall,
                          const std::vector<std::size_t>& seeds);

}  // namespace tether
