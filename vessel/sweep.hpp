#pragma once

#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "vessel/disc.hpp"
#include "vessel/regions.hpp"

namespace tether {

/// A vessel swept through closed cross-sections of its lumen.
/// Angles are right-handed about the flow (inlet to outlet): with flow along +z and angle_origin +x, angle = atan2(y,
/// x).
struct SweepSettings {
  std::vector<Points>
      sections;  ///< at least two closed planar polygons, inlet to outlet; planes may be oblique to the vessel
  Vec3 angle_origin{1, 0, 0};        ///< direction of angle zero, projected on each cross-section
  double extend_inlet = 0;           ///< straight extension beyond the first section, measured on the axis [length]
  double extend_outlet = 0;          ///< the same beyond the last
  double wall_thickness = 0;         ///< [length]
  int along = 20;                    ///< intervals along the vessel
  int layers = 2;                    ///< prisms through the wall
  DiscSettings disc;                 ///< how a cross-section of the lumen is filled
  std::string field = "mesh.swept";  ///< for messages, with its line if known
  std::string regions_field = "mesh.swept.regions";  ///< the same
  std::vector<WallRegion> regions;                   ///< of the outer wall, first match wins; none: one region "wall"
};

/// One of the `along + 1` cross-sections of the mesh.
struct CrossSection {
  Vec3 centre, normal;  ///< centre of area; unit normal along the flow
  Points rim;           ///< nodes of the lumen's edge, from angle zero
};

/// Cross-sections at equal distances along the axis. Sections given oblique to the vessel are interpolated to a smooth
/// surface (lines of equal angle: cubic Hermite with three-point slopes), which is cut anew across the axis; the first
/// and last keep their own planes, unless extended: an extension ends in a plane across the axis. Throws InputError.
std::vector<CrossSection> cross_sections(const SweepSettings& settings);

/// Conforming lumen and wall; patches "inlet" and "outlet", rings "inlet_ring" and "outlet_ring".
/// Throws InputError for sections, numbers or regions that give no valid mesh.
VesselMesh sweep(const SweepSettings& settings);

/// The two end circles of a straight tube about the z axis, inlet at z = 0, with four points for each of `around`.
std::vector<Points> circular_tube_sections(double radius, double length, int around);
/// A straight circular tube about the z axis, inlet at z = 0.
SweepSettings circular_tube_settings(double radius, double length, double thickness, int around, int along,
                                     int layers = 2);
VesselMesh circular_tube(double radius, double length, double thickness, int around, int along, int layers = 2);

}  // namespace tether
