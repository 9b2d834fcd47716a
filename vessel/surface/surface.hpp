#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A closed lumen surface whose triangles know which opening they close.
struct LabelledSurface {
  Points points;                      ///< [cm]
  std::vector<Triangle> triangles;    ///< outward
  std::vector<int> label;             ///< per triangle: 0 wall, k >= 1: opening k
  std::vector<std::string> openings;  ///< name of label k at k - 1
  int inlet = 0;                      ///< index into openings
};

}  // namespace tether
