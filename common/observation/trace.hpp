#pragma once

#include <optional>

#include "common/base/curve.hpp"
#include "common/config/case_file.hpp"
#include "common/observation/noise.hpp"

namespace tether {

/// A measured pressure or flow, to be compared with a column of timeseries.csv.
struct Trace {
  std::string name, observable;
  std::vector<double> times, values;  ///< as measured; pressures relative to the image's
  Curve curve;
  Noise noise;
  double period = 0;      ///< 0: it does not repeat [time]
  double tolerance = 0;   ///< how far from its ends a time still is one of the trace [time]
  bool held_out = false;  ///< it judges the model, and is not used to make it
  Dimension dimension = {};

  /// Linear between the values; nothing before the first or after the last, unless it repeats.
  std::optional<double> at(double time) const;
};

/// Reads it. Throws InputError "file:line: ...".
Trace load_trace(const std::string& name, const TraceCase& given, const CaseFile& file);

}  // namespace tether
