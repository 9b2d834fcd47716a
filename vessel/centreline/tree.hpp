#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A vessel of a tree: its centreline from where it leaves its parent.
struct Branch {
  std::string name;
  int parent = -1;            ///< index of the branch it leaves, -1: trunk
  std::vector<Vec3> points;   ///< [cm]
  std::vector<double> radii;  ///< of the largest inscribed sphere [cm], per point
};

/// The trunk first: from the inlet to the outlet it was asked to reach; every other branch begins on its parent's line.
struct CentrelineTree {
  std::vector<Branch> branches;
};

}  // namespace tether
