#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The interface as one code announces it.
struct InterfaceSurface {
  Points points;
  std::vector<Triangle> triangles;  ///< normals out of the fluid
};

/// Of its bounding box [length].
double diagonal(const Points& points);

/// A third of the areas around each node [length^2].
VectorXd nodal_areas(const InterfaceSurface& surface);

}  // namespace tether
