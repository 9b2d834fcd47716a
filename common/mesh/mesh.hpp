#pragma once

#include <vector>

#include "common/mesh/patch.hpp"

namespace tether {

/// The lumen: P1 tetrahedra with positive volume. Its boundary is the disjoint union of interface, inlets and outlets.
struct FluidMesh {
  Points points;  ///< [length]
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Triangle> interface;     ///< Sigma: triangles shared with the wall, oriented out of the fluid
  std::vector<Patch> inlets, outlets;  ///< flat or nearly flat end faces; their rims belong to Sigma as well
};

/// The wall: layered prisms (the default element) or tetrahedra, one of the two lists being empty.
/// A prism's bottom triangle 0 1 2 looks toward the lumen, its top 3 4 5 outward; volumes are positive.
/// The nodes of Sigma come first: node i < interface_nodes is the i-th interface node.
struct WallMesh {
  Points points;  ///< [length]
  std::vector<Prism> prisms;
  std::vector<Tetrahedron> tetrahedra;
  int interface_nodes = 0;
  std::vector<Triangle> interface;  ///< Sigma, indices < interface_nodes, oriented INTO the wall (out of the fluid)
  std::vector<Patch>
      outside;  ///< the outer surface by support region (spine, vicinity, opposite, ...), disjoint, outward
  std::vector<Patch> rings;  ///< end rings by name (inlet_ring, outlet_ring), outward; quads already split
};

/// Both sides of a vessel and how their interface nodes correspond.
struct VesselMesh {
  FluidMesh fluid;
  WallMesh wall;
};

/// Nodes used by the triangles, ascending, each once.
std::vector<int> nodes_of(const std::vector<Triangle>& triangles);

/// Six times the signed volume of a tetrahedron is the triple product of its edges; this is the volume itself.
double signed_volume(const Points& points, const Tetrahedron& tetrahedron);

/// Each prism split into three tetrahedra, conforming across neighbours (diagonals by the smaller node index).
std::vector<Tetrahedron> split_into_tetrahedra(const std::vector<Prism>& prisms);

/// The wall's prisms replaced by the tetrahedra they split into; faces stay as they are.
void use_tetrahedra(WallMesh& wall);

}  // namespace tether
