#pragma once

#include <algorithm>

#include "fsi_master/transfer/interface_surface.hpp"

namespace tether {

/// What gets lost between the two sides of an interface, relative to what is there: round-off where the map is right.
struct InterfaceBalance {
  double force = 0;   ///< of the sum of forces to the sum of their sizes
  double moment = 0;  ///< about the middle, at the places of the image; to the sum of the forces' moments
  double work = 0;    ///< of forces and motions; to the sum of the products' sizes

  void worst_of(const InterfaceBalance& other) {
    force = std::max(force, other.force);
    moment = std::max(moment, other.moment);
    work = std::max(work, other.work);
  }
};

/// Nodal forces [force] and motions of both sides, x0 y0 z0 x1 ...
struct InterfaceSide {
  const Points& points;
  VectorXd forces, motions;
};
InterfaceBalance balance(const InterfaceSide& fluid, const InterfaceSide& solid);

}  // namespace tether
