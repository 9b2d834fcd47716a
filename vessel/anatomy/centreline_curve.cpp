#include "vessel/anatomy/centreline_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"

namespace tether {

namespace {

constexpr double samples_per_radius = 5;

}  // namespace

CentrelineCurve::CentrelineCurve(const std::vector<Vec3>& points, const std::vector<double>& radii,
                                 const std::string& name) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(radii[i] > 0)) throw input_error("centreline {}: radius {} at point {}: must be positive", name, radii[i], i);
    if (kept.empty() || (points[i] - points[kept.back()]).norm() > radii[i] / 2) kept.push_back(i);
  }
  if (kept.size() > 1) kept.back() = points.size() - 1;  // the end stays where it is
  if (kept.size() < 2 && points.size() > 1) kept = {0, points.size() - 1};
  if (kept.size() < 2 || points[kept[0]] == points[kept[1]])
    throw input_error("centreline {}: has no length: give at least two points apart", name);
  knots_.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t i = 0; i < kept.size(); ++i) {
    knots_.col(static_cast<Eigen::Index>(i)) = points[kept[i]];
    radii_.push_back(radii[kept[i]]);
    u_.push_back(i == 0 ? 0 : u_.back() + (points[kept[i]] - points[kept[i - 1]]).norm());
  }
  fit();
  sample();
}

/// Second derivatives of the natural spline.
void CentrelineCurve::fit() {
  const Eigen::Index count = knots_.cols();
  MatrixXd system = MatrixXd::Identity(count, count);
  MatrixXd rates = MatrixXd::Zero(count, 3);
  for (Eigen::Index i = 1; i + 1 < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double before = u_[at] - u_[at - 1], after = u_[at + 1] - u_[at];
    system(i, i - 1) = before, system(i, i) = 2 * (before + after), system(i, i + 1) = after;
    rates.row(i) = 6 * ((knots_.col(i + 1) - knots_.col(i)) / after - (knots_.col(i) - knots_.col(i - 1)) / before);
  }
  second_ = system.partialPivLu().solve(rates).transpose();
}

CentrelineCurve::Motion CentrelineCurve::move(double u) const {
  const auto next = std::upper_bound(u_.begin() + 1, u_.end() - 1, u);
  const auto i = static_cast<Eigen::Index>(next - u_.begin()) - 1;
  const double h = *next - *(next - 1), b = (u - *(next - 1)) / h, a = 1 - b;
  const Vec3 p = knots_.col(i), q = knots_.col(i + 1), s = second_.col(i), t = second_.col(i + 1);
  return {a * p + b * q + h * h / 6 * ((a * a * a - a) * s + (b * b * b - b) * t),
          (q - p) / h + h / 6 * ((1 - 3 * a * a) * s + (3 * b * b - 1) * t), a * s + b * t};
}

double CentrelineCurve::radius(double u) const {
  const auto next = std::upper_bound(u_.begin() + 1, u_.end() - 1, u);
  const auto i = static_cast<std::size_t>(next - u_.begin());
  const double t = (u - u_[i - 1]) / (u_[i] - u_[i - 1]);
  return (1 - t) * radii_[i - 1] + t * radii_[i];
}

void CentrelineCurve::sample() {
  const double least = *std::min_element(radii_.begin(), radii_.end());
  const int count = std::clamp(static_cast<int>(std::ceil(u_.back() / least * samples_per_radius)), 8, 4000);
  for (int i = 0; i <= count; ++i) {
    const double u = u_.back() * i / count;
    double along = 0;
    if (i > 0) {  // Simpson
      const double step = u_.back() / count;
      along = samples_.back().along +
              step / 6 *
                  (move(u - step).velocity.norm() + 4 * move(u - step / 2).velocity.norm() + move(u).velocity.norm());
    }
    if (i > 0) longest_step_ = std::max(longest_step_, along - samples_.back().along);
    samples_.push_back({u, along, move(u).centre});
  }
  longest_step_ *= 1.001;  // of Simpson's rule
}

double CentrelineCurve::along_of(double u) const {
  const double step = samples_[1].u;
  const auto i = std::min(static_cast<std::size_t>(u / step), samples_.size() - 2);
  const double way = u - samples_[i].u;
  return samples_[i].along + way / 6 *
                                 (move(samples_[i].u).velocity.norm() +
                                  4 * move(samples_[i].u + way / 2).velocity.norm() + move(u).velocity.norm());
}

double CentrelineCurve::u_of(double along) const {
  const auto next = std::upper_bound(samples_.begin() + 1, samples_.end() - 1, along,
                                     [](double value, const Sample& s) { return value < s.along; });
  const Sample &a = *(next - 1), &b = *next;
  return a.u + (b.u - a.u) * std::clamp((along - a.along) / (b.along - a.along), 0.0, 1.0);
}

/// Newton's method for (c - x) c' = 0 within an interval, bisected where it leaves it.
double CentrelineCurve::refined(const Vec3& x, double u, double lower, double upper) const {
  const auto slope = [&](const Motion& m) { return (m.centre - x).dot(m.velocity); };
  if (slope(move(lower)) >= 0) return lower;
  if (slope(move(upper)) <= 0) return upper;
  for (int i = 0; i < 30; ++i) {
    const Motion m = move(u);
    const double g = slope(m), curvature = m.velocity.squaredNorm() + (m.centre - x).dot(m.acceleration);
    (g > 0 ? upper : lower) = u;
    const double next = curvature > 0 ? u - g / curvature : upper + 1;
    const double step = (next > lower && next < upper ? next : (lower + upper) / 2) - u;
    u += step;
    if (std::abs(step) < 1e-13 * u_.back()) break;
  }
  return u;
}

/// Of those from `first` on; the last, if there are none. A sample that is farther than the best so far has none that
/// is closer within as many steps as lie between.
std::size_t CentrelineCurve::nearest_sample(const Vec3& x, double first) const {
  const auto begin = std::lower_bound(samples_.begin(), samples_.end() - 1, first,
                                      [](const Sample& s, double value) { return s.u < value; });
  auto best = static_cast<std::size_t>(begin - samples_.begin());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = best; i < samples_.size();) {
    const double distance = (samples_[i].centre - x).norm();
    if (distance < least) best = i, least = distance;
    const double steps = (distance - least) / longest_step_;
    i += steps > 1 ? static_cast<std::size_t>(std::min(steps, static_cast<double>(samples_.size()))) : 1;
  }
  return best;
}

CentrelineCurve::Place CentrelineCurve::nearest(const Vec3& x, double from) const {
  const double first = from > 0 ? u_of(from) : 0;
  const std::size_t best = nearest_sample(x, first);
  const double lower = std::max(first, samples_[best > 0 ? best - 1 : 0].u),
               upper = std::max(lower, samples_[std::min(best + 1, samples_.size() - 1)].u);
  const double u = refined(x, std::clamp(samples_[best].u, lower, upper), lower, upper);
  const Motion m = move(u);
  Place place{along_of(u), m.centre, m.velocity.normalized(), radius(u), (x - m.centre).norm()};
  const double beyond = place.tangent.dot(x - place.centre);
  if ((u <= 0 && beyond < 0) || (u >= u_.back() && beyond > 0)) place.along += beyond;
  return place;
}

CentrelineCurve::Place CentrelineCurve::at(double along) const {
  const double u = u_of(along);
  const Motion m = move(u);
  return {along, m.centre, m.velocity.normalized(), radius(u), 0};
}

}  // namespace tether
