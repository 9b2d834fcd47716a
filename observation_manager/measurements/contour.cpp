#include "observation_manager/measurements/contour.hpp"

#include <algorithm>
#include <limits>

#include "common/base/error.hpp"

namespace tether {
namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace

Contour::Contour(Eigen::Matrix2Xd points, bool closed) : points_(std::move(points)), closed_(closed) {
  TETHER_ASSERT(points_.cols() >= 2, "{} points", points_.cols());
}

Vec2 Contour::normal(Eigen::Index segment) const {
  const Vec2 along = (end(segment) - start(segment)).normalized();
  return {along[1], -along[0]};
}

ClosestInPlane Contour::closest(const Vec2& x) const {
  Eigen::Index nearest = 0;
  double smallest = std::numeric_limits<double>::infinity(), place = 0;
  for (Eigen::Index i = 0; i < segments(); ++i) {
    const Vec2 along = end(i) - start(i);
    const double t = std::clamp((x - start(i)).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double squared = (start(i) + t * along - x).squaredNorm();
    if (squared < smallest) smallest = squared, nearest = i, place = t;
  }
  const Eigen::Index last = segments() - 1;
  ClosestInPlane result;
  result.pseudonormal = normal(nearest);
  const bool at_start = place == 0, at_finish = place == 1;
  result.at_end = !closed_ && ((at_start && nearest == 0) || (at_finish && nearest == last));
  if ((at_start || at_finish) && !result.at_end) {
    const Eigen::Index neighbour = at_start ? (nearest == 0 ? last : nearest - 1) : (nearest == last ? 0 : nearest + 1);
    result.pseudonormal = (result.pseudonormal + normal(neighbour)).normalized();
  }
  const Vec2 arm = start(nearest) + place * (end(nearest) - start(nearest)) - x;
  const double length = arm.norm(), scale = points_.cwiseAbs().maxCoeff();
  result.distance = result.pseudonormal.dot(arm) < 0 ? -length : length;  // (O.2)
  const bool has_direction = (at_start || at_finish) && length > 1e-13 * scale;
  result.normal = has_direction ? Vec2(arm / result.distance) : result.pseudonormal;  // (O.1)
  return result;
}

double Contour::length() const {
  double sum = 0;
  for (Eigen::Index i = 0; i < segments(); ++i) sum += (end(i) - start(i)).norm();
  return sum;
}

double Contour::signed_area() const {
  double sum = 0;
  for (Eigen::Index i = 0; i < points_.cols(); ++i)
    sum += 0.5 * cross(points_.col(i) - points_.col(0), points_.col((i + 1) % points_.cols()) - points_.col(0));
  return sum;
}

Contour Contour::reversed() const {
  return {points_.rowwise().reverse(), closed_};
}

bool Contour::crosses_itself() const {
  for (Eigen::Index i = 0; i < segments(); ++i)
    for (Eigen::Index j = i + 2; j < segments(); ++j) {
      if (closed_ && i == 0 && j == segments() - 1) continue;
      const Vec2 a = start(i), b = end(i), c = start(j), d = end(j);
      if (cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0) return true;
    }
  return false;
}

}  // namespace tether
