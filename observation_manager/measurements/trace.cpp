#include "observation_manager/measurements/trace.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/checked_file.hpp"
#include "observation_manager/measurements/independence.hpp"

namespace tether {

Trace::Trace(std::string name, std::string observable, std::vector<double> times, std::vector<double> values,
             Curve curve, Noise noise, double period, double tolerance, bool held_out, Dimension dimension, double zero)
    : name(std::move(name)),
      observable(std::move(observable)),
      times(std::move(times)),
      values(std::move(values)),
      curve(std::move(curve)),
      noise(noise),
      period(period),
      tolerance(tolerance),
      held_out(held_out),
      dimension(dimension),
      zero(zero) {}

std::optional<double> Trace::at(double time) const {
  const double reach = tolerance * (1 + 1e-9);
  if (period <= 0 && (time < times.front() - reach || time > times.back() + reach)) return std::nullopt;
  return curve(time);
}

std::vector<TraceValue> Trace::beside(const RunTrace& run) const {
  std::vector<std::pair<double, double>> found;
  const double round_off = 1e-9 * (run.times.back() - run.times.front());
  for (std::size_t i = 0; i < times.size(); ++i)
    if (const auto time = time_in_run(times[i], period, run.times.front(), run.times.back(), round_off))
      found.emplace_back(*time, values[i]);
  std::sort(found.begin(), found.end());
  const Curve model(run.times, run.values);
  std::vector<TraceValue> all;
  for (const auto& [time, measured] : found) all.push_back({time, measured, model(time)});
  return all;
}

MeasurementFacts Trace::facts() const {
  return {kinds::traces, name, noise, dimension, held_out};
}

std::uint64_t Trace::content() const {
  return hash_values(values, hash_values(times, 0));
}

std::vector<MeasuredPart> Trace::parts(const FinishedMotion& run) const {
  const std::vector<TraceValue> seen = beside(run.trace(observable));
  if (seen.empty()) return {};
  return {{.frame = {}, .time = seen.front().time, .is_record = true}};
}

std::vector<Datum> Trace::data(const FinishedMotion& run, const MeasuredPart&) const {
  const std::vector<TraceValue> seen = beside(run.trace(observable));
  const double apart =
      seen.size() > 1 ? (seen.back().time - seen.front().time) / static_cast<double>(seen.size() - 1) : 0;
  const double share = independent_share(apart, noise.correlation_time);
  std::vector<Datum> all;
  for (const TraceValue& value : seen)
    all.push_back({.residual = value.measured - value.model,
                   .independent = share,
                   .time = value.time,
                   .held_out = held_out,
                   .shown = value.measured + zero});
  return all;
}

CountedRows Trace::rows(const Points&, double) const {
  const std::vector<double> used = held_out ? std::vector<double>{} : times;
  const double precision = held_out ? 0 : 1 / std::pow(noise.deviation, 2);
  return {.series = {{used, period, tolerance, noise.correlation_time, precision, FrameCurve::chord}},
          .series_of = {0},
          .groups = {name},
          .region = {-1},
          .group_of = {0},
          .positions = Points(3, 0)};
}

std::vector<SeenRow> Trace::see(const ModelMoment& model, double time) const {
  return {{curve(time) - model.value(observable), 1}};
}

}  // namespace tether
