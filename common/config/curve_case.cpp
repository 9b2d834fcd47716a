#include "common/config/curve_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/config/columns.hpp"

namespace tether {
namespace {

void check_times(const CsvTable& table, const std::vector<double>& times, double period) {
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] <= times[i - 1])
      throw input_error("{}: the time {} does not come after {}", table.where(i), times[i], times[i - 1]);
  if (period > 0.0 && times.back() > times.front() + period * (1.0 + 1e-9))
    throw input_error("{}: the time {} lies beyond one period of {}", table.where(times.size() - 1), times.back(),
                      period);
}

/// A period after its first row a table has that value again; measured beats close to 5 % of their range.
void check_closes(const CsvTable& csv, const CurveCase::Table& told, double period) {
  constexpr double same_time = 1e-9, closes = 0.1;
  if (period <= 0.0 || told.times.back() < told.times.front() + period * (1.0 - same_time)) return;
  const auto [least, most] = std::minmax_element(told.values.begin(), told.values.end());
  if (std::abs(told.values.back() - told.values.front()) > closes * (*most - *least))
    throw input_error("{}: the value {:.6g} is a period of {:.6g} after the first one, {:.6g}: both are of one phase",
                      csv.where(told.times.size() - 1), told.values.back(), period, told.values.front());
}

/// From its last row back to the first value a curve is straight: nearly everywhere, where a table is so short.
void check_told(const CsvTable& csv, const CurveCase::Table& told, double period) {
  constexpr double most_periods = 10;
  const double length = told.times.back() - told.times.front();
  if (told.times.size() > 1 && period > most_periods * length && told.values.back() != told.values.front())
    throw input_error("{}: the table tells {:.3g} of a period of {:.3g} and does not end as it begins",
                      csv.where(told.times.size() - 1), length, period);
}

}  // namespace

void CurveCase::declare(Fields& f) {
  f.number("constant", constant, dimension, range::any, "a value that does not change; instead of a file");
  f.path("file", file, "comma-separated table whose first line names the columns");
  f.check(constant.has_value() != !file.empty(), "file", "give either a file or a constant");
  f.text("time", time, "name of the column of times");
  f.text("value", value, "name of the column of values");
  f.text("time_unit", time_unit, "unit of that column, if its heading does not state it as [unit]");
  f.text("value_unit", value_unit, "unit of that column, if its heading does not state it as [unit]");
  f.number("period", period, dimension::time, range::positive, "the table repeats after this time");
  f.number("ramp", ramp, dimension::time, range::not_negative,
           "time in which the value rises smoothly from zero at t = 0");
  f.number("scale", scale, dimension::none, range::any, "factor on all values");
  constexpr double most = 1e12;  // beyond any change of units
  f.check(std::abs(scale) <= most, "scale", "must be at least -1e12 and at most 1e12");
  check_column(f, "time", time, file);
  check_column(f, "value", value, file);
}

Curve CurveCase::load(const UnitSystem& units) const {
  const CurveShape shape{period.value_or(0.0), ramp, scale};
  if (constant) return Curve({0.0}, {*constant}, {0.0, ramp, scale});
  Table rows = table(units);
  return Curve(std::move(rows.times), std::move(rows.values), shape);
}

CurveCase::Table CurveCase::table(const UnitSystem& units) const {
  const CsvTable csv(file);
  std::vector<double> times = csv.quantities(time, units, dimension::time, time_unit);
  check_times(csv, times, period.value_or(0.0));
  Table told{std::move(times), csv.quantities(value, units, dimension, value_unit)};
  check_told(csv, told, period.value_or(0.0));
  check_closes(csv, told, period.value_or(0.0));
  return told;
}

}  // namespace tether
