#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A plane with a direction of angle zero; angles grow right-handed about the normal.
struct Frame {
  Vec3 centre, e1, e2, normal;
  Vec3 point(double angle, double radius) const;
};
/// angle_origin: any direction, projected on the plane. Throws InputError if it is nearly parallel to the normal.
Frame make_frame(const Vec3& centre, const Vec3& normal, const Vec3& angle_origin);

/// A closed polygon as distance from its centre of area over the angle, interpolated by a monotone cubic (no overshoot
/// at corners, exact at the polygon's points).
class PolarCurve {
 public:
  /// polygon: one column a point, planar to 5 % of its mean radius, star-shaped about its centre of area, run through
  /// in either sense. along: the side to which the normal points. name: for errors. Throws InputError.
  PolarCurve(const Points& polygon, const Vec3& along, const Vec3& angle_origin, const std::string& name);

  const Frame& frame() const { return frame_; }
  Vec3 point(double angle) const { return frame_.point(angle, radius(angle)); }
  double radius(double angle) const;
  /// `count` points at equal angles from angle zero.
  Points sample(int count) const;

 private:
  Frame frame_;
  std::vector<double> angles_, radii_, slopes_;  ///< ascending, periodic: the first repeated after 2 pi
};

/// Points of a circle at equal angles, right-handed about the normal.
Points circle(const Frame& frame, double radius, int count);

}  // namespace tether
