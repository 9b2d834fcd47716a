#include "identification_master/frame_sharing.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double round_off = 1e-6;  ///< of a step

}  // namespace

FrameSharing::FrameSharing(std::vector<double> times, double period, double tolerance, const StepEnds& ends,
                           double correlation_time, FrameCurve curve)
    : always_(!times.empty() && std::isnan(times.front())),
      frames_(std::move(times), period, round_off * ends.dt, curve),
      tolerance_(tolerance),
      correlation_time_(correlation_time),
      ends_(ends) {}

std::int64_t FrameSharing::step_before(double time) const {
  return static_cast<std::int64_t>(std::floor((time - ends_.start) / ends_.dt + round_off));
}

/// The first and the last; none if the first is behind the last.
std::pair<std::int64_t, std::int64_t> FrameSharing::steps_nearest_to(std::int64_t frame) const {
  const double time = frames_.time_of(frame);
  const bool alone = frames_.count() == 1;
  const double begin =
                   alone || !frames_.exists(frame - 1) ? time - tolerance_ : (frames_.time_of(frame - 1) + time) / 2,
               end = alone || !frames_.exists(frame + 1) ? time + tolerance_ : (time + frames_.time_of(frame + 1)) / 2;
  return {step_before(begin) + 1, step_before(end)};
}

std::int64_t FrameSharing::own_step_of(std::int64_t frame) const {
  const double steps = (frames_.time_of(frame) - ends_.start) / ends_.dt;
  const auto nearest = static_cast<std::int64_t>(std::ceil(steps - 0.5 - round_off));
  return nearest == 0 && steps > round_off ? 1 : nearest;  // nothing is seen before the end of the first
}

double FrameSharing::spacing_at(std::int64_t frame) const {
  const std::int64_t before = frames_.exists(frame - 1) ? frame - 1 : frame,
                     after = frames_.exists(frame + 1) ? frame + 1 : frame;
  if (before == after) return std::numeric_limits<double>::infinity();
  const double mean = (frames_.time_of(after) - frames_.time_of(before)) / static_cast<double>(after - before);
  return std::max(mean, ends_.dt);
}

SeenFrame FrameSharing::at(double end_of_step) const {
  SeenFrame seen;
  if (frames_.count() == 0) return seen;
  if (always_) return {.share = std::min(1.0, ends_.dt / ends_.length), .is_own = true};
  const std::int64_t step = step_before(end_of_step);
  const Between around = frames_.around(end_of_step);
  for (const std::int64_t frame : {around.before, around.before + 1}) {
    if (!frames_.exists(frame)) continue;
    seen.is_own = seen.is_own || own_step_of(frame) == step;
    const auto [first, last] = steps_nearest_to(frame);
    if (step < first || step > last) continue;
    const bool with_start = frames_.period() <= 0 && first <= 0 && last >= 0;  // where no step ends
    seen.share = 1.0 / static_cast<double>(last - first + (with_start ? 0 : 1));
    seen.apart = spacing_at(frame);
  }
  seen.error_square = frames_.error_square(around, correlation_time_);
  return seen;
}

std::array<FramePart, 4> FrameSharing::parts_at(double time) const {
  const Between around = frames_.around(time);
  std::array<FramePart, 4> all;
  for (std::size_t part = 0; part < around.parts.size(); ++part) {
    const std::int64_t frame = around.frame(part), slots = std::ssize(all);
    all[static_cast<std::size_t>((frame % slots + slots) % slots)] = {frame, around.parts[part]};
  }
  return all;
}

}  // namespace tether
