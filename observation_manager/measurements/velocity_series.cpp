#include "observation_manager/measurements/velocity_series.hpp"

#include <cmath>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "observation_manager/measurements/independence.hpp"
#include "observation_manager/measurements/registry.hpp"

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
  const std::vector<FrameShare> shares = times_.at(time);
  if (shares.empty()) return std::nullopt;
  Components by_curve = Components::Zero(settings_.axes.rows(), points_.cols()), by_chord = by_curve;
  for (const FrameShare& share : shares) {
    by_curve += share.of_curve * frames_[share.frame].values;
    if (share.of_chord != 0) by_chord += share.of_chord * frames_[share.frame].values;
  }
  return by_curve.array().isNaN().select(by_chord, by_curve);  // a neighbour lacks the point: (O.3)
}

/// How many independent errors those of all points amount to (D.6).
double VelocitySeries::independent_points() const {
  if (independent_ == 0) independent_ = effective_points(points_, settings_.noise.correlation_length);
  return independent_;
}

/// A cube of four correlation lengths; without one each point by itself.
std::array<int, 4> VelocitySeries::patch_of(Eigen::Index point) const {
  const double size = 4 * settings_.noise.correlation_length;
  if (!(size > 0)) return {static_cast<int>(point)};
  const Vec3 place = (points_.col(point) / size).array().floor();
  return {-1, static_cast<int>(place(0)), static_cast<int>(place(1)), static_cast<int>(place(2))};
}

MeasurementFacts VelocitySeries::facts() const {
  return {kinds::velocities, settings_.name, settings_.noise, dimension::velocity};
}

std::uint64_t VelocitySeries::content() const {
  std::uint64_t hash = hash_values(settings_.axes, hash_values(points_, 0));
  for (const VelocityFrame& frame : frames_) hash = hash_values(frame.values, hash_bytes(&frame.time, 8, hash));
  return hash;
}

std::vector<MeasuredPart> VelocitySeries::parts(const FinishedMotion& run) const {
  std::vector<MeasuredPart> all;
  for (std::size_t i = 0; i < frames_.size(); ++i)
    if (const auto time =
            time_in_run(frames_[i].time, settings_.period, run.motion.start, run.motion.end, settings_.tolerance))
      all.push_back({{0, i, frames_[i].time, frames_[i].held_out, static_cast<double>(i)}, *time});
  return all;
}

std::vector<Datum> VelocitySeries::data(const FinishedMotion& run, const MeasuredPart& part) const {
  const Components &measured = frames_[part.frame.number].values,
                   difference = measured - components(run.velocity(points_, part.time));
  const double share = independent_share(spacing(times_.times(), settings_.period), settings_.noise.correlation_time) *
                       independent_points() / static_cast<double>(points_.cols());
  std::vector<Datum> all;
  for (Eigen::Index point = 0; point < points_.cols(); ++point)
    for (Eigen::Index component = 0; component < difference.rows(); ++component) {
      const double now = difference(component, point);
      const bool is_seen = !std::isnan(now);
      all.push_back({.residual = is_seen ? now : 0,
                     .is_seen = is_seen,
                     .independent = is_seen ? share : 0,
                     .time = part.time,
                     .held_out = part.frame.held_out,
                     .component = static_cast<int>(component),
                     .patch = patch_of(point),
                     .position = points_.col(point)});
    }
  return all;
}

CountedRows VelocitySeries::rows(const Points&, double) const {
  CountedRows rows;
  std::vector<double> used;
  for (const VelocityFrame& frame : frames_)
    if (!frame.held_out) used.push_back(frame.time);
  const Noise& noise = settings_.noise;
  const double share = independent_points() / static_cast<double>(points_.cols());
  rows.series = {
      {used, settings_.period, settings_.tolerance, noise.correlation_time, share / std::pow(noise.deviation, 2)}};
  rows.groups = {settings_.name};
  const auto components = static_cast<std::size_t>(settings_.axes.rows());
  const std::size_t count = static_cast<std::size_t>(points_.cols()) * components;
  rows.series_of.assign(count, 0), rows.group_of.assign(count, 0), rows.region.assign(count, -1);
  rows.positions.resize(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i)
    rows.positions.col(static_cast<Eigen::Index>(i)) = points_.col(static_cast<Eigen::Index>(i / components));
  return rows;
}

std::vector<SeenRow> VelocitySeries::see(const ModelMoment& model, double time) const {
  const auto now = measured(time);
  std::vector<SeenRow> all(static_cast<std::size_t>(points_.cols() * settings_.axes.rows()));
  if (!now) return all;
  const Components difference = *now - components(model.velocity_at(points_));
  for (Eigen::Index i = 0; i < difference.size(); ++i)
    if (const double value = difference.data()[i]; !std::isnan(value)) all[static_cast<std::size_t>(i)] = {value, 1};
  return all;
}

}  // namespace tether
