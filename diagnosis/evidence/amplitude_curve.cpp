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

std::vector<AmplitudeCurve::Share> AmplitudeCurve::at(double size) const {
  if (points_.empty()) return {};
  std::size_t after = 0;
  while (after < points_.size() && std::abs(points_[after].size) < std::abs(size)) ++after;
  const double does = saturated(size);
  if (after == 0 || points_.size() == 1) return {{&points_[0], does / saturated(points_[0].size)}};
  const std::size_t to = std::min(after, points_.size() - 1), from = after == points_.size() ? 0 : to - 1;
  const double least = saturated(points_[from].size), share = (does - least) / (saturated(points_[to].size) - least);
  return {{&points_[from], 1 - share}, {&points_[to], share}};
}

void AmplitudeCurve::settle(const MatrixXd& columns, const VectorXd& precision) {
  scale_coarse(columns, precision);
  note_saturation(columns, precision);
}

/// Of two runs, of sizes a < b, the larger does R times as much: s = a b (R - 1)/(b - R a).
void AmplitudeCurve::note_saturation(const MatrixXd& columns, const VectorXd& precision) {
  if (points_.size() < 2) return;
  const auto does = [&](const Point& point) {
    const auto column = columns.col(point.column);
    return std::abs(point.factor) * std::sqrt(column.dot(precision.cwiseProduct(column)));
  };
  const double a = std::abs(points_.front().size), b = std::abs(points_.back().size),
               ratio = does(points_.back()) / does(points_.front());
  constexpr double at_once = 0.1;  // of the smallest run: what it does less of is not known
  if (ratio * a < b) half_at_ = std::max(a * b * (ratio - 1) / (b - ratio * a), at_once * a);
}

void AmplitudeCurve::scale_coarse(const MatrixXd& columns, const VectorXd& precision) {
  AmplitudeCurve coarse, fine;
  for (const Point& point : points_) (point.is_coarse ? coarse : fine).points_.push_back(point);
  if (coarse.points_.empty() || fine.points_.empty()) return;
  coarse.note_saturation(columns, precision);
  double both = 0, own = 0;
  for (const Point& point : fine.points_) {
    VectorXd seen = VectorXd::Zero(columns.rows());
    for (const Share& part : coarse.at(point.size))
      seen += part.share * part.point->factor * columns.col(part.point->column);
    both += point.factor * columns.col(point.column).dot(precision.cwiseProduct(seen));
    own += seen.dot(precision.cwiseProduct(seen));
  }
  for (Point& point : points_)
    if (point.is_coarse && both > 0) point.factor *= both / own;
  std::erase_if(points_, [&](const Point& point) {
    return point.is_coarse && std::any_of(fine.points_.begin(), fine.points_.end(), [&](const Point& other) {
             return factor_between(point.size, other.size) < near_a_run;
           });
  });
}

}  // namespace tether
