#include "identification_master/frame_sharing.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double round_off = 1e-6;  ///< of a step

}  // namespace

FrameSharing::FrameSharing(std::vector<double> times, double period, double tolerance, const StepEnds& ends)
    : times_(std::move(times)), period_(period), tolerance_(tolerance), ends_(ends) {
  while (period_ > 0 && times_.size() > 1 && times_.back() > times_.front() + period_ - round_off * ends_.dt)
    times_.pop_back();  // the first one again
}

bool FrameSharing::exists(std::int64_t frame) const {
  return period_ > 0 || (frame >= 0 && frame < std::ssize(times_));
}

double FrameSharing::time_of(std::int64_t frame) const {
  const std::int64_t count = std::ssize(times_), repetition = (frame >= 0 ? frame : frame - count + 1) / count;
  return times_[static_cast<std::size_t>(frame - repetition * count)] + static_cast<double>(repetition) * period_;
}

/// -1 before the first of a series that does not repeat.
std::int64_t FrameSharing::last_before(double time) const {
  const double slack = round_off * ends_.dt;
  const double repetition = period_ > 0 ? std::floor((time + slack - times_.front()) / period_) : 0;
  const auto after = std::upper_bound(times_.begin(), times_.end(), time - repetition * period_ + slack);
  return static_cast<std::int64_t>(repetition) * std::ssize(times_) + (after - times_.begin()) - 1;
}

std::int64_t FrameSharing::step_before(double time) const {
  return static_cast<std::int64_t>(std::floor((time - ends_.start) / ends_.dt + round_off));
}

/// The first and the last; none if the first is behind the last.
std::pair<std::int64_t, std::int64_t> FrameSharing::steps_nearest_to(std::int64_t frame) const {
  const double time = time_of(frame);
  const bool alone = times_.size() == 1;
  const double begin = alone || !exists(frame - 1) ? time - tolerance_ : (time_of(frame - 1) + time) / 2,
               end = alone || !exists(frame + 1) ? time + tolerance_ : (time + time_of(frame + 1)) / 2;
  return {step_before(begin) + 1, step_before(end)};
}

std::int64_t FrameSharing::own_step_of(std::int64_t frame) const {
  const double steps = (time_of(frame) - ends_.start) / ends_.dt;
  const auto nearest = static_cast<std::int64_t>(std::ceil(steps - 0.5 - round_off));
  return nearest == 0 && steps > round_off ? 1 : nearest;  // nothing is seen before the end of the first
}

double FrameSharing::spacing_at(std::int64_t frame) const {
  const std::int64_t before = exists(frame - 1) ? frame - 1 : frame, after = exists(frame + 1) ? frame + 1 : frame;
  if (before == after) return std::numeric_limits<double>::infinity();
  const double mean = (time_of(after) - time_of(before)) / static_cast<double>(after - before);
  return std::max(mean, ends_.dt);
}

/// s of (O.3): 0 at the frame, or behind the last; 1 at the next, or ahead of the first.
double FrameSharing::place_between(std::int64_t before, double time) const {
  if (!exists(before)) return 1;
  if (!exists(before + 1) || times_.size() == 1) return 0;
  return std::clamp((time - time_of(before)) / (time_of(before + 1) - time_of(before)), 0.0, 1.0);
}

SeenFrame FrameSharing::at(double end_of_step) const {
  SeenFrame seen;
  if (times_.empty()) return seen;
  if (std::isnan(times_.front())) return {.share = std::min(1.0, ends_.dt / ends_.length), .is_own = true};
  const std::int64_t step = step_before(end_of_step), before = last_before(end_of_step);
  for (const std::int64_t frame : {before, before + 1}) {
    if (!exists(frame)) continue;
    seen.is_own = seen.is_own || own_step_of(frame) == step;
    const auto [first, last] = steps_nearest_to(frame);
    if (step < first || step > last) continue;
    const bool with_start = period_ <= 0 && first <= 0 && last >= 0;  // where no step ends
    seen.share = 1.0 / static_cast<double>(last - first + (with_start ? 0 : 1));
    seen.apart = spacing_at(frame);
  }
  if (exists(before) && exists(before + 1) && times_.size() > 1) {
    seen.gap = time_of(before + 1) - time_of(before);
    seen.place = place_between(before, end_of_step);
  }
  return seen;
}

std::array<FramePart, 2> FrameSharing::parts_at(double time) const {
  const std::int64_t before = last_before(time);
  const double place = place_between(before, time);
  const FramePart earlier{before, 1 - place}, later{before + 1, place};
  if (before % 2 == 0) return {earlier, later};
  return {later, earlier};
}

}  // namespace tether
