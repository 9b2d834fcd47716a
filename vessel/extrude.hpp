#pragma once

#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"

namespace tether {

/// How a wall is grown outward from the lumen's surface.
struct ExtrusionSettings {
  double thickness = 0;  ///< [length]
  int layers = 2;
  int smoothing = 0;  ///< times that normals are averaged with their neighbours', for rough surfaces
};

/// A wall of prisms on the fluid's interface, along its nodal normals; those at an inlet or outlet stay in its plane,
/// so that end rings are flat. Interface nodes in ascending order of the fluid's; node i of layer k is `k *
/// interface_nodes + i`. `outside` is one patch "wall"; rings are named after their inlet or outlet: "inlet_ring".
/// Throws InputError if a rim of the interface meets no inlet or outlet, or a prism folds.
WallMesh extrude_wall(const FluidMesh& fluid, const ExtrusionSettings& settings);

}  // namespace tether
