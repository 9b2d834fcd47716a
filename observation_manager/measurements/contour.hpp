#pragma once

#include <vector>

#include "observation_manager/measurements/plane_cut.hpp"

namespace tether {

/// The place of a contour closest to a point of its plane.
struct ClosestInPlane {
  double distance = 0;  ///< positive where the contour lies outside the point (O.1) [length]
  Vec2 normal;          ///< unit, out of the lumen (O.1)
  Vec2 pseudonormal;    ///< of the contour itself there (O.2)
  bool at_end = false;  ///< of an open contour: the point lies beside what was measured
};

/// A polyline in a plane with the lumen on its left.
class Contour {
 public:
  /// One column a point, at least two, no two consecutive ones equal.
  Contour(Eigen::Matrix2Xd points, bool closed);

  ClosestInPlane closest(const Vec2& x) const;
  double length() const;
  /// Positive if it runs counterclockwise; an open one is closed by its chord [length^2].
  double signed_area() const;
  /// With the lumen on the other side.
  Contour reversed() const;
  /// Whether two of its segments cross.
  bool crosses_itself() const;
  const Eigen::Matrix2Xd& points() const { return points_; }
  bool closed() const { return closed_; }

 private:
  Eigen::Index segments() const { return closed_ ? points_.cols() : points_.cols() - 1; }
  Vec2 start(Eigen::Index segment) const { return points_.col(segment); }
  Vec2 end(Eigen::Index segment) const { return points_.col((segment + 1) % points_.cols()); }
  Vec2 normal(Eigen::Index segment) const;

  Eigen::Matrix2Xd points_;
  bool closed_;
};

}  // namespace tether
