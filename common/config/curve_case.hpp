#pragma once

#include "common/base/curve.hpp"
#include "common/base/units.hpp"
#include "common/config/fields.hpp"

namespace tether {

/// A function of time in a case: a constant, or columns of a CSV file.
///   flow: {file: inflow.csv, time: t_s, value: Q_cm3s, time_unit: s, value_unit: ml/s, period: 0.9}      flow:
///   {constant: 80 ml/s}
struct CurveCase {
  Dimension dimension;  ///< of the value; set by the owner
  std::optional<double> constant, period;
  std::filesystem::path file;
  std::string time = "time", value = "value", time_unit, value_unit;
  double ramp = 0.0, scale = 1.0;

  explicit CurveCase(Dimension of_value = {}) : dimension(of_value) {}
  void declare(Fields& f);
  bool given() const { return constant.has_value() || !file.empty(); }
  /// Reads the file, in the case's units: a column's unit is that of the case file, else the one in brackets in its
  /// heading, else the case's. Throws InputError "file:line: ...".
  Curve load(const UnitSystem& units) const;
  /// The file's rows, without period, ramp and scale.
  struct Table {
    std::vector<double> times, values;
  };
  Table table(const UnitSystem& units) const;
};

}  // namespace tether
