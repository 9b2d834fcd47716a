#pragma once

#include <string>

#include "common/base/units.hpp"
#include "fsi_master/transfer/interface_surface.hpp"

namespace tether {

/// How far two interfaces lie from each other, in the image.
struct InterfaceFit {
  int fluid_nodes = 0, wall_nodes = 0;
  double largest_gap = 0;                ///< wall outside the fluid's surface, at a fluid node [length]
  double largest_overlap = 0;            ///< wall inside [length]
  double rms_distance = 0;               ///< of the fluid's nodes from the wall, weighted by area [length]
  double fluid_area = 0, wall_area = 0;  ///< [length^2]
  double bare_area = 0;  ///< of the wall, farther from the fluid's surface than trusted: no load reaches it [length^2]
  double against_area = 0;  ///< of the fluid's surface, whose normals look against the wall's [length^2]

  double bare_share() const { return wall_area > 0 ? bare_area / wall_area : 0.0; }
  bool looks_away() const { return against_area > 0.5 * fluid_area; }
};

/// trust: [length]. Nothing is known of surfaces without triangles.
InterfaceFit interface_fit(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust);

/// "812 nodes of the fluid, 980 of the wall, which lies up to 0.1 mm outside ..."
std::string in_words(const InterfaceFit& fit, const UnitSystem& units);

}  // namespace tether
