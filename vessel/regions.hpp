#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/mesh/patch.hpp"

namespace tether {

/// A part of the outer wall by angle about the axis and position along it.
struct WallRegion {
  std::string name;
  double angle_from = 0, angle_to = 360;      ///< [degrees], may pass through zero: from 330 to 30
  double position_from = 0, position_to = 1;  ///< fraction of the whole length, extensions included
};

/// Where a node lies on the vessel.
struct WallPlace {
  double angle;     ///< [degrees], 0 .. 360
  double position;  ///< 0 at the inlet, 1 at the outlet
};

/// Patches in the order of `regions`: each place is of the first that contains it, angle and position being linear on
/// every triangle, so that borders cut triangles and areas do not depend on the mesh. Throws InputError for a place
/// without region, or a region that has the most of no triangle; field: where the regions are given, for messages.
std::vector<Patch> divide_by_regions(const std::vector<Triangle>& triangles, const std::vector<WallRegion>& regions,
                                     const std::string& field, const std::function<WallPlace(int node)>& place);

/// What of a patch lies where a function of the nodes is between two values, itself linear on every triangle and
/// growing along the vessel: its border cuts triangles too. Of `triangles` those of which it has half or more.
Patch part_between(const Patch& patch, const VectorXd& function, double from, double to);

/// What of a patch lies within a distance of a point, and what beyond, by areas that depend little on the mesh:
/// triangles are divided down to an eighth of the distance before their edges are cut. Of `triangles` those of which
/// each has half or more.
struct NearAndFar {
  Patch near, far;
};
NearAndFar divided_by_distance(const Patch& patch, const Points& points, const Vec3& centre, double distance);

/// Of each region the names of those that share an edge or a triangle with it, in the regions' order.
using Neighbours = std::map<std::string, std::vector<std::string>>;
Neighbours neighbours_of(const std::vector<Patch>& regions);

/// By how much the nodes of a region are nearer to one of its neighbours than to the others: (far - near)/(far + near)
/// of the distances in space, 1 at the neighbour, -1 at the others; zero at nodes elsewhere.
VectorXd nearness(const std::string& neighbour, const std::string& region, const std::vector<Patch>& regions,
                  const Points& points);

}  // namespace tether
