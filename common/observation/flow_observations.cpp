#include "common/observation/flow_observations.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {
namespace {

double value_of(const Trace& trace, const ModelFlow& model) {
  const auto found = std::find(model.names.begin(), model.names.end(), trace.observable);
  if (found == model.names.end())
    throw input_error("observations.traces.{}.observable: the run has no {}; it has: {}", trace.name, trace.observable,
                      fmt::join(model.names, ", "));
  return model.values[static_cast<std::size_t>(found - model.names.begin())];
}

FlowSample sample_of(const Trace& trace, double modelled, double time, int source) {
  const auto measured = trace.at(time);
  const Exclusion excluded = trace.held_out ? Exclusion::held_out : !measured ? Exclusion::no_frame : Exclusion::none;
  return {excluded == Exclusion::none ? *measured - modelled : 0, trace.noise.deviation, source, excluded};
}

std::vector<FlowSample> samples_of(const VelocitySeries& series, const Points& velocity, double time, int source) {
  std::vector<FlowSample> samples;
  const Components modelled = series.components(velocity);
  const auto measured = series.measured(time);
  for (Eigen::Index point = 0; point < modelled.cols(); ++point)
    for (Eigen::Index i = 0; i < modelled.rows(); ++i) {
      const bool has_data = measured && !std::isnan((*measured)(i, point));
      const Exclusion excluded = !has_data                        ? Exclusion::no_frame
                                 : std::isnan(modelled(i, point)) ? Exclusion::missed
                                                                  : Exclusion::none;
      const double difference = excluded == Exclusion::none ? (*measured)(i, point) - modelled(i, point) : 0;
      samples.push_back({difference, series.settings().noise.deviation, source, excluded});
    }
  return samples;
}

}  // namespace

Points FlowObservations::points() const {
  Points all(3, 0);
  for (const VelocitySeries& series : velocities) {
    const Eigen::Index before = all.cols();
    all.conservativeResize(3, before + series.points().cols());
    all.rightCols(series.points().cols()) = series.points();
  }
  return all;
}

std::vector<FlowSample> FlowObservations::observe(const ModelFlow& model, double time) const {
  std::vector<FlowSample> samples;
  int source = 0;
  for (const Trace& trace : traces) samples.push_back(sample_of(trace, value_of(trace, model), time, source++));
  Eigen::Index first = 0;
  for (const VelocitySeries& series : velocities) {
    const Eigen::Index count = series.points().cols();
    const auto of_series = samples_of(series, model.velocities.middleCols(first, count), time, source++);
    samples.insert(samples.end(), of_series.begin(), of_series.end());
    first += count;
  }
  return samples;
}

FlowObservations load_flow_observations(const ObservationsCase& given, const CaseFile& file) {
  FlowObservations result;
  for (const auto& [name, trace] : given.traces) result.traces.push_back(load_trace(name, trace, file));
  for (const auto& [name, velocities] : given.velocities)
    result.velocities.push_back(load_velocities(name, velocities, file));
  return result;
}

}  // namespace tether
