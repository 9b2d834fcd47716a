#include "vessel/polar_curve.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"

namespace tether {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Vec3 centre_of_area(const Points& polygon, const Plane& plane) {
  Vec3 moment = Vec3::Zero();
  double area = 0;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vec3 a = polygon.col(i) - plane.origin, b = polygon.col((i + 1) % polygon.cols()) - plane.origin;
    const double part = a.cross(b).dot(plane.normal);
    moment += part * (a + b) / 3.0;
    area += part;
  }
  return plane.origin + moment / area;
}

/// Slopes of the monotone cubic of Fritsch and Butland on a periodic sequence whose last value repeats the first.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t intervals = x.size() - 1;
  std::vector<double> slopes(x.size());
  for (std::size_t i = 0; i < intervals; ++i) {
    const std::size_t before = (i + intervals - 1) % intervals;
    const double h0 = x[before + 1] - x[before], h1 = x[i + 1] - x[i];
    const double d0 = (y[before + 1] - y[before]) / h0, d1 = (y[i + 1] - y[i]) / h1;
    if (d0 * d1 > 0) slopes[i] = 3 * (h0 + h1) / ((2 * h1 + h0) / d0 + (h1 + 2 * h0) / d1);
  }
  slopes.back() = slopes.front();
  return slopes;
}

void require_planar(const Points& polygon, const Frame& frame, const std::string& name) {
  const Points arms = polygon.colwise() - frame.centre;
  const double off = (frame.normal.transpose() * arms).cwiseAbs().maxCoeff(), radius = arms.colwise().norm().mean();
  if (off > 0.05 * radius)
    throw input_error("{}: a point lies {:.3g} off the section's plane: at most 5 % of the mean radius {:.3g}", name,
                      off, radius);
}

}  // namespace

Vec3 Frame::point(double angle, double radius) const {
  return centre + radius * (std::cos(angle) * e1 + std::sin(angle) * e2);
}

Frame make_frame(const Vec3& centre, const Vec3& normal, const Vec3& angle_origin) {
  const Vec3 n = normal.normalized();
  const Vec3 in_plane = angle_origin - angle_origin.dot(n) * n;
  if (!(in_plane.norm() > 0.2 * angle_origin.norm()))
    throw input_error(
        "mesh: angle_origin ({:.3g}, {:.3g}, {:.3g}) is nearly parallel to the vessel at ({:.3g}, {:.3g}, {:.3g}): "
        "choose a direction across the vessel",
        angle_origin[0], angle_origin[1], angle_origin[2], centre[0], centre[1], centre[2]);
  const Vec3 e1 = in_plane.normalized();
  return {centre, e1, n.cross(e1), n};
}

PolarCurve::PolarCurve(const Points& polygon, const Vec3& along, const Vec3& angle_origin, const std::string& name) {
  if (polygon.cols() < 8) throw input_error("{}: has {} points: at least 8 are needed", name, polygon.cols());
  const Plane plane = plane_of_loop(polygon);
  const Vec3 normal = plane.normal.dot(along) < 0 ? Vec3(-plane.normal) : plane.normal;
  frame_ = make_frame(centre_of_area(polygon, plane), normal, angle_origin);
  require_planar(polygon, frame_, name);

  std::vector<std::pair<double, double>> polar;  // as run through, right-handed about the normal
  const bool reversed = plane.normal.dot(along) < 0;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Vec3 arm = polygon.col(reversed ? polygon.cols() - 1 - i : i) - frame_.centre;
    const double x = arm.dot(frame_.e1), y = arm.dot(frame_.e2), angle = std::atan2(y, x);
    polar.emplace_back(angle < -1e-12 ? angle + full_turn : std::max(angle, 0.0), std::hypot(x, y));
  }
  std::rotate(polar.begin(), std::min_element(polar.begin(), polar.end()), polar.end());
  polar.emplace_back(polar.front().first + full_turn, polar.front().second);
  for (const auto& [angle, radius] : polar) {
    if (!angles_.empty() && angle <= angles_.back())
      throw input_error(
          "{}: is not star-shaped: a ray from its centre ({:.3g}, {:.3g}, {:.3g}) meets it more than once", name,
          frame_.centre[0], frame_.centre[1], frame_.centre[2]);
    angles_.push_back(angle);
    radii_.push_back(radius);
  }
  slopes_ = monotone_slopes(angles_, radii_);
}

double PolarCurve::radius(double angle) const {
  angle -= full_turn * std::floor((angle - angles_.front()) / full_turn);
  const auto above = std::upper_bound(angles_.begin() + 1, angles_.end() - 1, angle);
  const auto i = static_cast<std::size_t>(above - angles_.begin()) - 1;
  const double h = angles_[i + 1] - angles_[i], t = (angle - angles_[i]) / h, s = 1 - t;
  return s * s * (1 + 2 * t) * radii_[i] + t * t * (1 + 2 * s) * radii_[i + 1] +
         h * s * t * (s * slopes_[i] - t * slopes_[i + 1]);
}

Points PolarCurve::sample(int count) const {
  Points points(3, count);
  for (int k = 0; k < count; ++k) points.col(k) = point(full_turn * k / count);
  return points;
}

Points circle(const Frame& frame, double radius, int count) {
  Points points(3, count);
  for (int k = 0; k < count; ++k) points.col(k) = frame.point(full_turn * k / count, radius);
  return points;
}

}  // namespace tether
