#include "observation_manager/measurements/frame_times.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {

FrameTimes::FrameTimes(std::vector<double> times, double period, double tolerance, const std::vector<bool>& held_out)
    : times_(std::move(times)), period_(period), tolerance_(tolerance), held_out_(held_out) {
  TETHER_ASSERT(std::is_sorted(times_.begin(), times_.end(), std::less_equal{}), "times do not ascend");
  held_out_.resize(times_.size(), false);
  for (std::size_t frame = 0; frame < times_.size(); ++frame)
    if (!held_out_[frame]) used_.push_back(frame);
}

std::optional<Between> FrameTimes::at(double time) const {
  if (used_.empty()) return std::nullopt;
  const std::size_t first = used_.front(), last = used_.back();
  if (std::isnan(times_[first])) return Between{first, first, 0.0};
  if (period_ > 0) time -= period_ * std::floor((time - times_[first]) / period_);
  const auto above = std::upper_bound(used_.begin(), used_.end(), time,
                                      [this](double t, std::size_t frame) { return t < times_[frame]; });
  const bool is_before = above == used_.begin(), is_behind = above == used_.end();
  if (period_ > 0 && used_.size() > 1 && is_behind)
    return Between{last, first, (time - times_[last]) / (times_[first] + period_ - times_[last])};
  if (!is_before && !is_behind) {
    const std::size_t before = *(above - 1), after = *above;
    return Between{before, after, (time - times_[before]) / (times_[after] - times_[before])};
  }
  for (const std::size_t end : {first, last})
    for (const double away : {std::abs(time - times_[end]), period_ - std::abs(time - times_[end])})
      if (std::abs(away) <= tolerance_ * (1 + 1e-9)) return Between{end, end, 0.0};
  return std::nullopt;
}

}  // namespace tether
