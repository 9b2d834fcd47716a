#pragma once

#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"

namespace tether {

/// The model's lumen, Sigma, as it was imaged, and what of the vessel each node belongs to. Node i is the i-th
/// interface node.
struct LumenSurface {
  Points points;                    ///< of the image [length]
  std::vector<Triangle> triangles;  ///< normals out of the lumen
  std::vector<std::string> region_names;
  std::vector<int> region;           ///< of each node: that of the closest part of the outer wall
  VectorXd from_inlet, from_outlet;  ///< of each node: to the nearest node of an inlet's, an outlet's rim [length]
};

LumenSurface lumen_of(const VesselMesh& vessel);

/// At its nodes: a third of the areas of their triangles [length^2], and outward unit normals
/// (common/mesh/surface.hpp).
VectorXd nodal_areas(const LumenSurface& lumen);
Points nodal_normals(const LumenSurface& lumen);

}  // namespace tether
