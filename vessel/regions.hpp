#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/mesh.hpp"

namespace tether {

/// A part of the outer wall by angle about the axis and position along it.
struct WallRegion {
  std::string name;
  double angle_from = 0, angle_to = 360;      ///< [degrees], may pass through zero: from 330 to 30
  double position_from = 0, position_to = 1;  ///< fraction of the whole length, extensions included
  bool contains(double angle, double position) const;
};

/// Where a triangle lies on the vessel.
struct WallPlace {
  double angle;     ///< [degrees], 0 .. 360
  double position;  ///< 0 at the inlet, 1 at the outlet
};

/// Triangles sorted into patches by the first region that contains them; patches in the order of `regions`.
/// Throws InputError for a triangle without region or a region without triangle.
std::vector<Patch> divide_by_regions(const std::vector<Triangle>& triangles, const std::vector<WallRegion>& regions,
                                     const std::function<WallPlace(const Triangle&)>& place);

}  // namespace tether
