#include "observation_manager/measurements/frame_times.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr double slack = 1e-6;  ///< of the tolerance, which is that of a step

std::vector<std::size_t> used_of(std::size_t count, const std::vector<bool>& held_out) {
  std::vector<std::size_t> used;
  for (std::size_t frame = 0; frame < count; ++frame)
    if (!held_out[frame]) used.push_back(frame);
  return used;
}

std::vector<double> chosen(const std::vector<double>& times, const std::vector<std::size_t>& frames) {
  std::vector<double> of;
  for (const std::size_t frame : frames) of.push_back(times[frame]);
  return of;
}

std::vector<bool> filled(std::vector<bool> held_out, std::size_t count) {
  held_out.resize(count, false);
  return held_out;
}

}  // namespace

FrameTimes::FrameTimes(std::vector<double> times, double period, double tolerance, const std::vector<bool>& held_out)
    : times_(std::move(times)),
      tolerance_(tolerance),
      held_out_(filled(held_out, times_.size())),
      used_(used_of(times_.size(), held_out_)),
      sequence_(chosen(times_, used_), period, slack * tolerance) {
  TETHER_ASSERT(std::is_sorted(times_.begin(), times_.end(), std::less_equal{}), "times do not ascend");
}

bool FrameTimes::reaches(double time) const {
  const double first = times_[used_.front()], last = times_[used_.back()], period = sequence_.period();
  const double reach = tolerance_ * (1 + 1e-9);
  if (period <= 0) return time >= first - reach && time <= last + reach;
  return used_.size() > 1 || std::abs(std::remainder(time - first, period)) <= reach;
}

std::vector<FrameShare> FrameTimes::at(double time) const {
  if (used_.empty()) return {};
  if (std::isnan(times_[used_.front()])) return {{used_.front(), 1, 1}};
  if (!reaches(time)) return {};
  const Between around = sequence_.around(time);
  const std::array<double, 4> chord{0, 1 - around.place, around.place, 0};
  std::vector<FrameShare> shares;
  for (std::size_t part = 0; part < chord.size(); ++part)
    if (around.parts[part] != 0)
      shares.push_back({used_[sequence_.number_of(around.frame(part))], around.parts[part], chord[part]});
  return shares;
}

}  // namespace tether
