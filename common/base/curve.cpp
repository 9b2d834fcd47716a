#include "common/base/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"

namespace tether {

double onset(double time, double ramp) {
  return ramp > 0 ? 0.5 * (1 - std::cos(std::numbers::pi * std::clamp(time / ramp, 0.0, 1.0))) : 1.0;
}

Curve::Curve(std::vector<double> times, std::vector<double> values, const CurveShape& shape)
    : times_(std::move(times)), values_(std::move(values)), shape_(shape) {
  TETHER_ASSERT(!times_.empty() && times_.size() == values_.size(), "{} {}", times_.size(), values_.size());
  TETHER_ASSERT(std::is_sorted(times_.begin(), times_.end(), std::less_equal{}), "times do not increase");
  const double period = shape_.period;
  if (period <= 0.0) return;
  TETHER_ASSERT(times_.back() <= times_.front() + period * (1.0 + 1e-9), "{} {} {}", times_.front(), times_.back(),
                period);
  if (times_.size() > 1 && times_.back() >= times_.front() + period * (1.0 - 1e-9)) return;
  times_.push_back(times_.front() + period);
  values_.push_back(values_.front());
}

double Curve::operator()(double time) const {
  return shape_.scale * onset(time, shape_.ramp) * interpolated(time);
}

double Curve::interpolated(double time) const {
  if (shape_.period > 0.0) time -= shape_.period * std::floor((time - times_.front()) / shape_.period);
  const auto after = std::upper_bound(times_.begin(), times_.end(), time);
  if (after == times_.begin()) return values_.front();
  if (after == times_.end()) return values_.back();
  const auto i = static_cast<std::size_t>(after - times_.begin());
  const double s = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
  return (1.0 - s) * values_[i - 1] + s * values_[i];
}

}  // namespace tether
