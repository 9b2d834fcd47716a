#include "fluid/curve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"

namespace tether::fluid {

Curve::Curve(std::vector<double> times, std::vector<double> values, double period)
    : times_(std::move(times)), values_(std::move(values)), period_(period) {
  if (times_.empty() || times_.size() != values_.size())
    throw input_error("a curve needs as many values as times, and at least one: {} times, {} values", times_.size(), values_.size());
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (!std::isfinite(times_[i]) || !std::isfinite(values_[i])) throw input_error("a curve has no number at point {}", i + 1);
    if (i > 0 && times_[i] <= times_[i - 1])
      throw input_error("the times of a curve must increase: {} follows {}", times_[i], times_[i - 1]);
  }
  if (period_ == 0) return;
  const double span = times_.back() - times_.front();
  if (period_ < 0 || span > period_ * (1 + 1e-9))
    throw input_error("a curve's period {} is shorter than the {} it covers", period_, span);
  if (span < period_ * (1 - 1e-9)) {  // close the loop
    times_.push_back(times_.front() + period_);
    values_.push_back(values_.front());
  }
}

double Curve::operator()(double time) const {
  if (times_.empty()) return 0;
  if (period_ > 0) time -= period_ * std::floor((time - times_.front()) / period_);
  if (time <= times_.front()) return values_.front();
  if (time >= times_.back()) return values_.back();
  const auto right = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin());
  const double s = (time - times_[right - 1]) / (times_[right] - times_[right - 1]);
  return (1 - s) * values_[right - 1] + s * values_[right];
}

std::vector<std::complex<double>> Curve::harmonics(int count) const {
  TETHER_ASSERT(period_ > 0, "harmonics of a curve without period");
  const int samples = 64 * (count + 1);
  std::vector<std::complex<double>> result(static_cast<std::size_t>(count) + 1);
  for (int k = 0; k <= count; ++k)
    for (int i = 0; i < samples; ++i) {
      const double phase = static_cast<double>(i) / samples;
      result[static_cast<std::size_t>(k)] +=
          (k == 0 ? 1.0 : 2.0) / samples * (*this)(phase * period_) * std::polar(1.0, -2 * std::numbers::pi * k * phase);
    }
  return result;
}

}  // namespace tether::fluid
