#pragma once

#include <array>

#include "common/mesh/triangle_locator.hpp"

namespace tether {

/// A triangle's plane, and a linear field on it: that of the nodes' values, over all of space constant along the
/// normal.
struct TrianglePlane {
  explicit TrianglePlane(const Mat3& corners);
  /// Barycentric coordinates of the point's projection; outside the triangle one of them is negative.
  Vec3 barycentric(const Vec3& x) const { return Vec3::Constant(1.0 / 3) + gradients.transpose() * (x - middle); }
  double height(const Vec3& x) const { return normal.dot(x - middle); }

  Vec3 middle, normal;
  Mat3 gradients;  ///< of the hat functions, one column a corner [1/length]
};

/// How a point beside a triangulated surface moves with it: as the plane of a triangle does, whose stretching, shearing
/// and turning it follows. A point beside a surface that moves rigidly moves rigidly with it.
struct FollowedPlace {
  Triangle nodes{-1, -1, -1};  ///< of the triangle
  std::array<Mat3, 3> shares;  ///< of their motions (C.10)
  double height = 0;           ///< over the triangle, along its normal [length]
};
FollowedPlace followed_place(const Triangle& nodes, const TrianglePlane& plane, const Vec3& point);

/// With the nearest triangle, and how far it is.
struct NearestPlace {
  FollowedPlace place;
  double distance = 0;  ///< [length]
};
NearestPlace nearest_place(const TriangleLocator& surface, const Vec3& point);

}  // namespace tether
