#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

using Vec2 = Eigen::Vector2d;

/// A plane with coordinates: x = origin + a e1 + b e2, e1 x e2 = normal.
struct SlicePlane {
  Vec3 origin, e1, e2, normal;
  Vec2 flat(const Vec3& x) const { return {(x - origin).dot(e1), (x - origin).dot(e2)}; }
  Vec3 lifted(const Vec2& direction) const { return direction[0] * e1 + direction[1] * e2; }
};

/// The plane closest to some points (least squares) and how far the worst lies from it. Throws InputError, beginning
/// with `name`, if the points lie on a line.
struct FittedPlane {
  SlicePlane plane;
  double deviation;
};
FittedPlane fitted_plane(const std::string& name, const Points& points);

/// A place on a triangulated surface: shares of three nodes.
struct SurfacePlace {
  Triangle nodes{};
  Vec3 shares{1, 0, 0};
};

/// A connected piece of the curve in which a plane cuts a surface, in the direction that has the surface's normals on
/// its right: around a lumen counterclockwise about the plane's normal.
struct CutPiece {
  std::vector<SurfacePlace> places;  ///< where it crosses edges of the surface; one of the shares is zero
  Points points;                     ///< of these places, one column each
  bool closed = false;
};

/// A node in the plane counts as before it, so that every crossed edge is crossed once.
std::vector<CutPiece> cut_by_plane(const Points& x, const std::vector<Triangle>& triangles, const SlicePlane& plane);

}  // namespace tether
