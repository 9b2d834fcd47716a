#include "diagnosis/comparison/trace_discrepancy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/comparison/statistics.hpp"

namespace tether {
std::optional<double> TraceDiscrepancy::z() const {
  if (noise.deviation <= 0 || times.empty()) return std::nullopt;
  return bias * std::sqrt(effective) / noise.deviation;  // (D.3)
}

TraceDiscrepancy compare(const Trace& data, const RunTrace& run) {
  TraceDiscrepancy result{data.name, data.observable, run.unit, data.noise, {}, {}, {}};
  result.held_out = data.held_out;
  const std::vector<TraceValue> found = data.beside(run);
  result.outside = static_cast<int>(data.times.size() - found.size());
  double squares = 0;
  for (const TraceValue& value : found) {
    const double difference = value.measured - value.model;
    result.times.push_back(value.time);
    result.measured.push_back(value.measured);
    result.model.push_back(value.model);
    squares += difference * difference;
    result.bias += difference / static_cast<double>(found.size());
    result.largest = std::max(result.largest, std::abs(difference));
  }
  if (found.empty()) return result;
  result.rms = std::sqrt(squares / static_cast<double>(found.size()));
  result.effective = effective_number(found.back().time - found.front().time, 1, data.noise.correlation_time,
                                      static_cast<int>(found.size()));
  return result;
}

ShownUnit shown_in(const std::string& unit, const UnitSystem& units) {
  if (unit == units.symbol(dimension::pressure)) return {units.to_mmhg(1), "mmHg"};
  if (unit == units.symbol(dimension::flow)) return {units.to_ml_per_s(1), "ml/s"};
  if (unit == units.symbol(dimension::length)) return {units.to_mm(1), "mm"};
  return {1, unit};
}

namespace {

double range_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

/// What looks like a slip of who wrote the case rather than like a model that is off.
std::string doubt_of(const TraceDiscrepancy& trace) {
  constexpr double other_unit = 5, other_zero = 2;
  const double measured = range_of(trace.measured), model = range_of(trace.model);
  if (trace.times.size() < 3 || !(measured > 0) || !(model > 0)) return {};
  if (const double ratio = measured / model; ratio > other_unit || ratio < 1 / other_unit)
    return fmt::format(". It swings {:.3g} times as far as the model: is its unit right?", ratio);
  if (std::abs(trace.bias) > other_zero * std::max(measured, model))
    return ". Its mean is off by more than twice its swing: is it measured from the same zero (a pressure's "
           "`absolute`)?";
  return {};
}

}  // namespace

std::string sentence_of(const TraceDiscrepancy& trace, const UnitSystem& units) {
  const std::string name = trace.name + (trace.held_out ? ", held out" : "");
  if (trace.times.empty()) return fmt::format("{}: the run reaches none of its times", name);
  const auto [factor, unit] = shown_in(trace.unit, units);
  const std::string sigma = trace.z() ? fmt::format(" ({:.1f} sigma)", std::abs(*trace.z())) : "";
  return fmt::format("{}: {} is {:.3g} {} too {} on average{}, {:.3g} off in root mean square{}", name,
                     trace.observable, factor * std::abs(trace.bias), unit, trace.bias > 0 ? "low" : "high", sigma,
                     factor * trace.rms, doubt_of(trace));
}

}  // namespace tether
