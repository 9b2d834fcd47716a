#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Shape of tetrahedra. Radius ratio: three times the inscribed over the circumscribed radius, 1 for a regular one, 0
/// for a flat one.
struct Quality {
  double min_radius_ratio = 1, mean_radius_ratio = 1;
  double min_dihedral = 70.5;  ///< [degrees]
  int worst = -1;              ///< element of the smallest radius ratio
};

double radius_ratio(const Points& points, const Tetrahedron& tetrahedron);
double min_dihedral_angle(const Points& points, const Tetrahedron& tetrahedron);  ///< [degrees]
Quality quality(const Points& points, const std::vector<Tetrahedron>& tetrahedra);

}  // namespace tether
