#include "observation_manager/measurements/frame_sequence.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

/// Frames that are nearer to their neighbour than this share of the gap bend no curve across it: their errors would
/// count several times as much in it.
constexpr double least_distance = 0.5;
/// Of the way between two frames: what the other one lacks is no loss.
constexpr double round_off = 1e-9;
/// Of a series that repeats: of fewer the same one would stand on either side.
constexpr std::int64_t least_frames = 4;

}  // namespace

FrameSequence::FrameSequence(std::vector<double> times, double period, double slack, FrameCurve curve)
    : times_(std::move(times)), period_(period), slack_(slack), curve_(curve) {
  while (period_ > 0 && times_.size() > 1 && times_.back() > times_.front() + period_ * (1 - round_off) - slack_)
    times_.pop_back();
}

bool FrameSequence::exists(std::int64_t frame) const {
  return !times_.empty() && (period_ > 0 || (frame >= 0 && frame < count()));
}

std::size_t FrameSequence::number_of(std::int64_t frame) const {
  const std::int64_t rest = frame % count();
  return static_cast<std::size_t>(rest < 0 ? rest + count() : rest);
}

double FrameSequence::time_of(std::int64_t frame) const {
  const std::size_t number = number_of(frame);
  const std::int64_t repetition = (frame - static_cast<std::int64_t>(number)) / count();
  return times_[number] + static_cast<double>(repetition) * period_;
}

std::int64_t FrameSequence::last_before(double time) const {
  const double repetition = period_ > 0 ? std::floor((time + slack_ - times_.front()) / period_) : 0;
  const auto after = std::upper_bound(times_.begin(), times_.end(), time - repetition * period_ + slack_);
  return static_cast<std::int64_t>(repetition) * count() + (after - times_.begin()) - 1;
}

/// 0 at the frame, or behind the last; 1 at the next, or ahead of the first.
double FrameSequence::place_between(std::int64_t before, double time) const {
  if (!exists(before)) return 1;
  if (!exists(before + 1) || count() == 1 || time <= time_of(before) + slack_) return 0;
  const double place = (time - time_of(before)) / (time_of(before + 1) - time_of(before));
  return place < round_off ? 0 : place > 1 - round_off ? 1 : place;
}

/// By the polynomial through the two frames around the time and their neighbours, where there are such.
std::array<double, 4> FrameSequence::parts_of(const Between& chord, double time) const {
  std::array<double, 4> parts{0, 1 - chord.place, chord.place, 0};
  if (curve_ == FrameCurve::chord || chord.place == 0 || chord.place == 1) return parts;
  if (period_ > 0 && count() < least_frames) return parts;
  const double before = time_of(chord.before), after = time_of(chord.before + 1), gap = after - before;
  std::vector<std::size_t> used;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (!exists(chord.frame(part))) continue;
    const double here = time_of(chord.frame(part));
    if (part == 1 || part == 2 || std::max(before - here, here - after) >= least_distance * gap * (1 - 1e-6))
      used.push_back(part);
  }
  for (const std::size_t part : used) {  // Lagrange
    parts[part] = 1;
    for (const std::size_t other : used)
      if (other != part) {
        const double there = time_of(chord.frame(other));
        parts[part] *= (time - there) / (time_of(chord.frame(part)) - there);
      }
  }
  return parts;
}

Between FrameSequence::around(double time) const {
  Between found;
  found.before = last_before(time);
  found.place = place_between(found.before, time);
  found.parts = parts_of(found, time);
  return found;
}

double FrameSequence::error_square(const Between& around, double correlation_time) const {
  double sum = 0;
  for (std::size_t i = 0; i < around.parts.size(); ++i)
    for (std::size_t j = 0; j < around.parts.size(); ++j) {
      const double both = around.parts[i] * around.parts[j];
      if (both == 0) continue;
      const double apart = std::abs(time_of(around.frame(i)) - time_of(around.frame(j)));
      sum += both * (i == j ? 1 : correlation_time > 0 ? std::exp(-apart / correlation_time) : 0);
    }
  return sum;
}

}  // namespace tether
