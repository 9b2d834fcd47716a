#pragma once

#include <array>
#include <vector>

#include "common/mesh/mesh.hpp"

namespace tether {

/// A rectangular box of tetrahedra from the origin, for verification.
struct BoxMesh {
  Points points;
  std::vector<Tetrahedron> tetrahedra;
  std::array<Patch, 6> sides;  ///< x_min, x_max, y_min, y_max, z_min, z_max; outward
};

/// cells[i] cubes along axis i, each cut into six tetrahedra around its diagonal (Kuhn). Node (i, j, k) is i + (nx+1)
/// (j + (ny+1) k).
BoxMesh box_mesh(const Vec3& size, const std::array<int, 3>& cells);

}  // namespace tether
