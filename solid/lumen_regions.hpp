#pragma once

#include <vector>

#include "common/mesh/mesh.hpp"

namespace tether {

/// Region of each triangle of the interface: number of the patch of the outer wall whose triangle is nearest.
std::vector<int> regions_of_interface(const WallMesh& mesh);

}  // namespace tether
