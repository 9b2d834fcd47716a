#include "diagnosis/comparison/velocity_discrepancy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "observation_manager/measurements/independence.hpp"

namespace tether {
namespace {

/// Columns of a matrix: the points with numbers.
std::vector<Eigen::Index> columns_with_numbers(const Components& values) {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < values.cols(); ++i)
    if (!values.col(i).array().isNaN().any()) columns.push_back(i);
  return columns;
}

VelocityStatistics statistics_of(const Components& measured, const Components& difference) {
  VelocityStatistics s;
  s.used = static_cast<int>(difference.cols());
  if (s.used == 0) return s;
  s.rms = std::sqrt(difference.array().square().mean());  // (D.6)
  s.largest = difference.cwiseAbs().maxCoeff();
  s.measured = std::sqrt(measured.array().square().mean());
  if (difference.rows() == 1) s.bias = difference.mean();
  return s;
}

VelocityMoment moment_of(const VelocitySeries& data, const VelocityFrame& frame, double time, const Points& velocity) {
  const std::vector<Eigen::Index> known = columns_with_numbers(frame.values);
  const Components measured = frame.values(Eigen::all, known),
                   difference = measured - data.components(velocity)(Eigen::all, known);
  const std::vector<Eigen::Index> both = columns_with_numbers(difference);
  VelocityMoment moment{time, frame.time, frame.held_out, static_cast<int>(known.size() - both.size()), {}};
  moment.found = statistics_of(measured(Eigen::all, both), difference(Eigen::all, both));
  if (moment.found.used > 0)
    moment.found.effective =
        effective_points(data.points()(Eigen::all, known)(Eigen::all, both), data.settings().noise.correlation_length);
  return moment;
}

/// Over the moments of a kind.
VelocityStatistics pooled(const std::vector<VelocityMoment>& moments, bool held_out) {
  VelocityStatistics all;
  double squares = 0, measured = 0, sum = 0;
  for (const VelocityMoment& moment : moments) {
    if (moment.held_out != held_out) continue;
    const VelocityStatistics& s = moment.found;
    all.used += s.used;
    squares += s.used * s.rms * s.rms, measured += s.used * s.measured * s.measured, sum += s.used * s.bias;
    all.largest = std::max(all.largest, s.largest);
  }
  if (all.used == 0) return all;
  all.rms = std::sqrt(squares / all.used), all.measured = std::sqrt(measured / all.used), all.bias = sum / all.used;
  return all;
}

std::string sentence_of(const VelocityDiscrepancy& velocity, bool held_out, const UnitSystem& units) {
  const VelocityStatistics& s = held_out ? velocity.held_out : velocity.training;
  if (s.used == 0) return {};
  const double metres = units.in_si(dimension::velocity);
  const VelocityMoment* worst = nullptr;
  for (const VelocityMoment& moment : velocity.moments)
    if (moment.held_out == held_out && (worst == nullptr || moment.found.rms > worst->found.rms)) worst = &moment;
  std::string text =
      fmt::format("{}{}: velocities are {:.3g} m/s off in root mean square (measured: {:.3g} m/s", velocity.name,
                  held_out ? ", held-out frames" : "", metres * s.rms, metres * s.measured);
  if (const double unit = velocity.noise.deviation; unit > 0)
    text += fmt::format("; {:.1f} times the noise", s.rms / unit);
  return text + fmt::format("), worst at {:.3g} s: {:.3g} m/s", worst->time, metres * worst->found.rms);
}

}  // namespace

std::optional<double> VelocityDiscrepancy::z(const VelocityMoment& moment) const {
  if (noise.deviation <= 0 || components != 1 || moment.found.used == 0) return std::nullopt;
  return moment.found.bias * std::sqrt(moment.found.effective) / noise.deviation;  // (D.3)
}

VelocityDiscrepancy compare(const VelocitySeries& data, const RunVelocity& run, Eigen::Index first) {
  const VelocitySeries::Settings& settings = data.settings();
  VelocityDiscrepancy result;
  result.name = settings.name;
  result.unit = run.unit;
  result.noise = settings.noise;
  result.components = static_cast<int>(settings.axes.rows());
  result.points = static_cast<int>(data.points().cols());
  for (const VelocityFrame& frame : data.frames())
    if (const auto time = time_in_run(frame.time, settings.period, run.start, run.end, settings.tolerance))
      result.moments.push_back(moment_of(data, frame, *time, run.at(*time).middleCols(first, data.points().cols())));
    else
      ++result.outside;
  std::stable_sort(result.moments.begin(), result.moments.end(),
                   [](const VelocityMoment& a, const VelocityMoment& b) { return a.time < b.time; });
  result.training = pooled(result.moments, false);
  result.held_out = pooled(result.moments, true);
  return result;
}

std::vector<std::string> sentences_of(const VelocityDiscrepancy& velocity, const UnitSystem& units) {
  std::vector<std::string> all;
  for (const bool held_out : {false, true})
    if (std::string sentence = sentence_of(velocity, held_out, units); !sentence.empty())
      all.push_back(std::move(sentence));
  if (all.empty()) all.push_back(velocity.name + ": none of its points and frames is in the run's lumen");
  if (velocity.outside > 0)
    all.push_back(fmt::format("{}: {} of {} frames are outside the run", velocity.name, velocity.outside,
                              velocity.moments.size() + static_cast<std::size_t>(velocity.outside)));
  return all;
}

}  // namespace tether
