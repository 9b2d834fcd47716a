#include "common/observation/velocity_series.hpp"

#include "common/base/error.hpp"

namespace tether {
namespace {

FrameTimes times_of(const std::vector<VelocityFrame>& frames, const VelocitySeries::Settings& settings) {
  std::vector<double> times;
  std::vector<bool> held_out;
  for (const VelocityFrame& frame : frames) {
    times.push_back(frame.time);
    held_out.push_back(frame.held_out);
  }
  return {std::move(times), settings.period, settings.tolerance, held_out};
}

}  // namespace

VelocitySeries::VelocitySeries(Settings settings, Points points, std::vector<VelocityFrame> frames)
    : settings_(std::move(settings)),
      points_(std::move(points)),
      frames_(std::move(frames)),
      times_(times_of(frames_, settings_)) {
  for (const VelocityFrame& frame : frames_)
    TETHER_ASSERT(frame.values.rows() == settings_.axes.rows() && frame.values.cols() == points_.cols(), "{} x {}",
                  frame.values.rows(), frame.values.cols());
}

std::optional<Components> VelocitySeries::measured(double time) const {
  const auto between = times_.at(time);
  if (!between) return std::nullopt;
  const Components &before = frames_[between->before].values, &after = frames_[between->after].values;
  if (between->share == 0) return before;
  return (1 - between->share) * before + between->share * after;
}

}  // namespace tether
