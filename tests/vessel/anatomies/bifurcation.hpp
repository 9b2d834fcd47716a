#pragma once

#include "vessel/centreline/tree.hpp"

namespace tether {

/// The open surface of a straight trunk about z, 0 to 6 long, and a branch along x to 2.6, without a fillet in the
/// crotch: triangles outward, nodes on the analytic surface, rims in the planes of its ends.
struct Bifurcation {
  static constexpr double trunk_radius = 1.2, branch_radius = 0.4, length = 6, branch_height = 3, branch_end = 2.6;
  Points points;
  std::vector<Triangle> triangles;
  CentrelineTree tree;
};
Bifurcation bifurcation(double edge);

/// Open circular tubes of triangles about z: their surface is right to the square of the edges.
struct TubeSurface {
  Points points;
  std::vector<Triangle> triangles;
};
TubeSurface tube_surface(double radius, double length, int around, int along, const Vec3& at = Vec3::Zero());
TubeSurface torus_surface(double large, double small, int around, int along);
TubeSurface together(const TubeSurface& one, const TubeSurface& other);

}  // namespace tether
