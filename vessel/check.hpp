#pragma once

#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "common/mesh/mesh.hpp"
#include "vessel/quality.hpp"

/// What must hold of a mesh before anything is computed on it. Each check throws InputError naming the object, the
/// value and the rule.
namespace tether {

/// Elements of positive volume and no flat ones, in one part; every boundary triangle in exactly one of interface,
/// inlets, outlets; at least one inlet or outlet; no empty face.
void check(const FluidMesh& fluid);
/// The same of the wall, with the outside and the rings.
void check(const WallMesh& wall);
/// The i-th interface node of the wall is the i-th of the fluid, within 1e-6 of the lumen's diameter, and so are the
/// triangles.
void check_interface(const VesselMesh& vessel);
/// Diameter and wall thickness of a vessel, not of a pipeline or a hair.
void check_size(const VesselMesh& vessel, const UnitSystem& units);

/// All of the above. `where` the mesh is given, for messages about its size: "case.yaml:7: mesh".
void check(const VesselMesh& vessel, const UnitSystem& units, const std::string& where = "mesh");

/// Four volumes over the lumen's surface: the diameter of a tube [length].
double mean_lumen_diameter(const FluidMesh& fluid);
/// Volume over mean of inner and outer surface [length].
double mean_wall_thickness(const WallMesh& wall);

/// What a person wants to know of a mesh.
struct MeshReport {
  int fluid_nodes = 0, fluid_elements = 0, wall_nodes = 0, wall_elements = 0;
  Quality fluid, wall;  ///< prisms as the tetrahedra they split into
  double lumen_diameter = 0, wall_thickness = 0, lumen_volume = 0;
};
MeshReport report(const VesselMesh& vessel);

}  // namespace tether
