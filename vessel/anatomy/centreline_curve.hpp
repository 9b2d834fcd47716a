#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The line of a branch as a smooth curve: a natural cubic spline through its points (those nearer to the one before
/// than half a radius left out), with radii between them linear. Places of a surface about it vary smoothly, as long as
/// they are nearer to it than its radius of curvature.
class CentrelineCurve {
 public:
  /// Throws InputError, naming `name`: fewer than two points apart, a radius that is not positive.
  CentrelineCurve(const std::vector<Vec3>& points, const std::vector<double>& radii, const std::string& name);

  struct Place {
    double along;  ///< from the first point on; less than 0, or more than the length, before and behind the curve
    Vec3 centre, tangent;
    double radius, distance;  ///< `distance` to the centre [length]
  };
  /// The nearest place; not before `from` (then `along` is `from`).
  Place nearest(const Vec3& x, double from = 0) const;
  Place at(double along) const;
  double length() const { return samples_.back().along; }

 private:
  struct Sample {
    double u, along;
    Vec3 centre;
  };
  struct Motion {
    Vec3 centre, velocity, acceleration;
  };
  Motion move(double u) const;
  double radius(double u) const;
  std::size_t nearest_sample(const Vec3& x, double first) const;
  double refined(const Vec3& x, double u, double lower, double upper) const;
  double u_of(double along) const;
  double along_of(double u) const;
  void fit();
  void sample();

  std::vector<double> u_, radii_;
  Points knots_, second_;  ///< second derivatives at the knots
  std::vector<Sample> samples_;
  double longest_step_ = 0;  ///< between samples [length]
};

}  // namespace tether
