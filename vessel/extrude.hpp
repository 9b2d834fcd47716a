#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"

namespace tether {

/// How a wall is grown outward from the lumen's surface.
struct ExtrusionSettings {
  double thickness = 0;  ///< [length]
  int layers = 2;
  int smoothing = 0;  ///< times that normals are averaged with their neighbours', for rough surfaces
  /// Thickness at places of the lumen's surface, instead of `thickness`.
  std::function<VectorXd(const Points&)> varying = {};
  double least_share = 1;                           ///< of the asked thickness that must be reached everywhere
  std::string field = "mesh.swept.wall_thickness";  ///< that says how thick, for messages, with its line if known
};

/// A grown wall, and how thick it came out: one value an interface node.
struct GrownWall {
  WallMesh wall;
  VectorXd asked, thickness;  ///< distance of the outer nodes to the lumen [length]
  int moved = 0;              ///< outer nodes that had to leave their place straight above
};

/// A wall of prisms on the fluid's interface, along its nodal normals, and where these would fold (in the crotch of a
/// branch) as near to that as can be: see `grow_outer_surface`. Nodes at an inlet or outlet stay in its plane, so that
/// end rings are flat. Interface nodes in ascending order of the fluid's; node i of layer k is `k * interface_nodes +
/// i`. `outside` is one patch "wall"; rings are named after their inlet or outlet: "inlet_ring".
/// Throws InputError if a rim of the interface meets no inlet or outlet, or the wall has no room.
GrownWall grow_wall(const FluidMesh& fluid, const ExtrusionSettings& settings);
WallMesh extrude_wall(const FluidMesh& fluid, const ExtrusionSettings& settings);

}  // namespace tether
