#include "common/observation/trace.hpp"

namespace tether {

std::optional<double> Trace::at(double time) const {
  if (period <= 0 && (time < times.front() - tolerance || time > times.back() + tolerance)) return std::nullopt;
  return curve(time);
}

Trace load_trace(const std::string& name, const TraceCase& given, const CaseFile& file) {
  CurveCase::Table table = given.curve.table(file.units());
  const bool shifted = given.quantity == "pressure" && given.absolute;
  for (double& time : table.times) time += given.time_shift;
  for (double& value : table.values) value = given.curve.scale * value - (shifted ? file.common().image.pressure : 0);
  const double period = given.curve.period.value_or(0);
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
          given.curve.dimension};
}

}  // namespace tether
