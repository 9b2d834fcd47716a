#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "observation_manager/measurements/flow_observations.hpp"
#include "observation_manager/measurements/stated_unit.hpp"

namespace tether {
namespace {

/// The units must be stated, in the file or in the case.
void check_units(const TraceCase& given, const UnitSystem& units) {
  const CsvTable table(given.curve.file);
  if (given.curve.time_unit.empty()) check_unit(table, given.curve.time, "ms");
  if (given.curve.value_unit.empty()) check_unit(table, given.curve.value, units.symbol(given.curve.dimension));
}

/// Pressures and flows of the blood have names that say so (docs/protocol.md).
void check_quantity(const TraceCase& given, const std::string& where) {
  for (const char* quantity : {"pressure", "flow"})
    if (given.observable.ends_with(std::string(".") + quantity) && given.quantity != quantity)
      throw input_error("{}.quantity: {}, but {} is a {}", where, given.quantity, given.observable, quantity);
}

/// A trace that does not repeat must have something to say during the run.
void check_range(const std::vector<double>& times, double period, const TimeCase& run, const std::string& where) {
  if (period > 0 || (times.front() <= run.end && times.back() >= run.start)) return;
  throw input_error("{}: its times are from {:g} to {:g}, the run is from {:g} to {:g}: period or time_shift?", where,
                    times.front(), times.back(), run.start, run.end);
}

void load_traces_of(const KindSection& given, const CaseFile& file, FlowObservations& to) {
  for (const auto& [name, trace] : sources_of<TraceCase>(given)) to.traces.push_back(load_trace(name, trace, file));
}

}  // namespace

Trace load_trace(const std::string& name, const TraceCase& given, const CaseFile& file) {
  const std::string where = file.where("observations.traces." + name);
  check_quantity(given, where);
  check_units(given, file.units());
  CurveCase::Table table = given.curve.table(file.units());
  const bool shifted = given.quantity == "pressure" && given.absolute;
  for (double& time : table.times) time += given.time_shift;
  const double zero = shifted ? file.common().image.pressure : 0;
  for (double& value : table.values) value *= given.curve.scale;
  given.correction.faults.correct(table.values);
  for (double& value : table.values) value -= zero;
  const double period = given.curve.period.value_or(0);
  check_range(table.times, period, file.common().time, where);
  Curve curve(table.times, table.values, {.period = period});
  return {name,
          given.observable,
          std::move(table.times),
          std::move(table.values),
          std::move(curve),
          noise_of(given.noise),
          period,
          0.5 * file.common().time.step,
          given.held_out,
          given.curve.dimension,
          zero};
}

const MeasurementKind kinds::traces{.name = "traces",
                                    .meaning = "measured pressures and flows, by name",
                                    .formats = "one .csv with a column of times and one of values",
                                    .fallible = fallible::instrument,
                                    .on_lumen = false,
                                    .section = section_of<TraceCase, kinds::traces>,
                                    .load = load_traces_of};

}  // namespace tether
