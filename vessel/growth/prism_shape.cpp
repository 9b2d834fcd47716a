#include "vessel/growth/prism_shape.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tether {

namespace {

constexpr std::array<double, 3> levels{0, 0.5, 1};
constexpr double places = 9;

/// The derivative of a determinant by its matrix.
Mat3 cofactors(const Mat3& t) {
  Mat3 c;
  c.col(0) = t.col(1).cross(t.col(2));
  c.col(1) = t.col(2).cross(t.col(0));
  c.col(2) = t.col(0).cross(t.col(1));
  return c;
}

}  // namespace

PrismShape::PrismShape(const Mat3& base, const Vec3& heights) : base_(base) {
  const Vec3 normal = (base.col(1) - base.col(0)).cross(base.col(2) - base.col(0)).normalized();
  for (Eigen::Index corner = 0; corner < 3; ++corner) {
    Mat3 asked;
    asked << base.col((corner + 1) % 3) - base.col(corner), base.col((corner + 2) % 3) - base.col(corner),
        heights[corner] * normal;
    to_asked_[static_cast<std::size_t>(corner)] = asked.inverse();
  }
}

/// visit(corner, level, T).
template <class Visit>
void PrismShape::at_places(const Mat3& top, Visit visit) const {
  for (const double level : levels) {
    const Mat3 here = (1 - level) * base_ + level * top;
    for (Eigen::Index corner = 0; corner < 3; ++corner) {
      Mat3 actual;
      actual << here.col((corner + 1) % 3) - here.col(corner), here.col((corner + 2) % 3) - here.col(corner),
          top.col(corner) - base_.col(corner);
      visit(corner, level, Mat3(actual * to_asked_[static_cast<std::size_t>(corner)]));
    }
  }
}

double PrismShape::worst(const Mat3& top) const {
  double least = std::numeric_limits<double>::infinity();
  at_places(top, [&](Eigen::Index, double, const Mat3& t) { least = std::min(least, t.determinant()); });
  return least;
}

double PrismShape::energy(const Mat3& top, double softening, Mat3& derivative) const {
  double sum = 0;
  at_places(top, [&](Eigen::Index corner, double level, const Mat3& t) {
    const Mat3 cofactor = cofactors(t);
    const double det = t.col(0).dot(cofactor.col(0)), root = std::hypot(det, softening);
    // for strongly folded prisms det + root cancels
    const double chi = det > 0 ? (det + root) / 2 : softening * softening / (2 * (root - det));
    const double power = std::cbrt(chi * chi), here = t.squaredNorm() / (3 * power);
    sum += here;
    const Mat3 by_t = 2 * t / (3 * power) - 2.0 / 3 * here / chi * (chi / root) * cofactor;  // chi' = chi / root
    const Mat3 by_actual = by_t * to_asked_[static_cast<std::size_t>(corner)].transpose() / places;
    const Eigen::Index next = (corner + 1) % 3, other = (corner + 2) % 3;
    derivative.col(next) += level * by_actual.col(0);
    derivative.col(other) += level * by_actual.col(1);
    derivative.col(corner) += by_actual.col(2) - level * (by_actual.col(0) + by_actual.col(1));
  });
  return sum / places;
}

}  // namespace tether
