#pragma once

#include "vessel/image/image_case.hpp"
#include "vessel/image/image_volume.hpp"

namespace tether {

/// A front that stands still where grey values change most.
struct LevelSet {
  ImageVolume field;  ///< positive in the lumen
  int iterations = 0;
  bool stood_still = true;
  bool grew_again = false;  ///< it was ended, for it grew faster again after it had all but stood still
  double edge = 0;          ///< change of grey values at the wall [per cm]
};

/// The geodesic active contour of Caselles, Kimmel and Sapiro (1997) from the seeds outward (M.21), not into stops,
/// basins of neighbours, or values beyond a threshold. `seeds`, `neighbours`: voxels. Throws InputError if there is no
/// edge around the seeds, or they are not of one kind.
LevelSet level_set(const ImageVolume& image, const LumenImageCase& how, const std::vector<std::size_t>& seeds,
                   const std::vector<std::size_t>& neighbours);

}  // namespace tether
