#include "diagnosis/evidence/amplitude_curve.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

/// How much larger than the other one of two sizes is.
double factor_between(double a, double b) {
  return std::exp(std::abs(std::log(a / b)));
}

}  // namespace

void AmplitudeCurve::add(const Point& point) {
  constexpr double same = 1 + 1e-6;
  const auto is_known = [&](const Point& other) {
    return other.is_coarse == point.is_coarse && factor_between(other.size, point.size) < same;
  };
  if (std::any_of(points_.begin(), points_.end(), is_known)) return;
  const auto after = std::find_if(points_.begin(), points_.end(),
                                  [&](const Point& other) { return std::abs(other.size) > std::abs(point.size); });
  points_.insert(after, point);
}

/// The size that would do as much if the effect went on as it begins: size/(1 + size/s).
double AmplitudeCurve::saturated(double size) const {
  return std::abs(size) / (1 + std::abs(size) / half_at_);
}

std::vector<AmplitudeCurve::Share> AmplitudeCurve::along(const Points& points, double size) const {
  if (points.empty()) return {};
  std::size_t after = 0;
  while (after < points.size() && std::abs(points[after].size) < std::abs(size)) ++after;
  const double does = saturated(size);
  if (after == 0 || points.size() == 1) return {{&points[0], does / saturated(points[0].size)}};
  const std::size_t to = std::min(after, points.size() - 1), from = after == points.size() ? 0 : to - 1;
  const double least = saturated(points[from].size), share = (does - least) / (saturated(points[to].size) - least);
  return {{&points[from], 1 - share}, {&points[to], share}};
}

std::vector<AmplitudeCurve::Share> AmplitudeCurve::at(double size) const {
  if (fine_.empty()) return along(points_, size);
  std::vector<Share> all = along(coarse_, size);
  const double within = std::min(std::abs(size), std::abs(fine_.back().size));
  for (const Share& own : along(fine_, std::copysign(within, size))) {
    all.push_back(own);
    for (const Share& instead : along(coarse_, own.point->size))
      all.push_back({instead.point, -own.share * instead.share});
  }
  return all;
}

std::vector<AmplitudeCurve::Share> AmplitudeCurve::from_coarse() const {
  std::vector<Share> all{{&fine_.back(), 1}};
  for (const Share& instead : along(coarse_, fine_.back().size))
    all.push_back({instead.point, -instead.share / coarse_times_});
  return all;
}

void AmplitudeCurve::settle(const MatrixXd& columns, const VectorXd& precision) {
  for (const Point& point : points_) (point.is_coarse ? coarse_ : fine_).push_back(point);
  note_saturation(coarse_.size() > 1 ? coarse_ : points_, columns, precision);
  if (coarse_.empty() || fine_.empty())
    coarse_.clear(), fine_.clear();
  else
    scale_coarse(columns, precision);
}

/// Of two runs, of sizes a < b, the larger does R times as much: s = a b (R - 1)/(b - R a).
void AmplitudeCurve::note_saturation(const Points& points, const MatrixXd& columns, const VectorXd& precision) {
  if (points.size() < 2) return;
  const auto does = [&](const Point& point) {
    const auto column = columns.col(point.column);
    return std::abs(point.factor) * std::sqrt(column.dot(precision.cwiseProduct(column)));
  };
  const double a = std::abs(points.front().size), b = std::abs(points.back().size),
               ratio = does(points.back()) / does(points.front());
  constexpr double at_once = 0.1;  // of the smallest run: what it does less of is not known
  if (ratio * a < b) half_at_ = std::max(a * b * (ratio - 1) / (b - ratio * a), at_once * a);
}

void AmplitudeCurve::scale_coarse(const MatrixXd& columns, const VectorXd& precision) {
  double both = 0, own = 0;
  for (const Point& point : fine_) {
    VectorXd seen = VectorXd::Zero(columns.rows());
    for (const Share& part : along(coarse_, point.size))
      seen += part.share * part.point->factor * columns.col(part.point->column);
    both += point.factor * columns.col(point.column).dot(precision.cwiseProduct(seen));
    own += seen.dot(precision.cwiseProduct(seen));
  }
  if (both > 0) coarse_times_ = both / own;
  for (Point& point : coarse_) point.factor *= coarse_times_;
}

}  // namespace tether
