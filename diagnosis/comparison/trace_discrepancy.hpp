#pragma once

#include <optional>

#include "common/base/units.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// A measured pressure or flow set against the same of a run, at the times of the measurement.
struct TraceDiscrepancy {
  std::string name, observable, unit;
  Noise noise;
  std::vector<double> times, measured, model;  ///< in the order of the run's times
  int outside = 0;                             ///< measured values at times that the run does not reach
  double rms = 0, largest = 0, bias = 0;       ///< bias: mean of measured minus model
  double effective = 0;                        ///< number of independent values (D.2)
  bool held_out = false;                       ///< not used to make the model
  std::optional<double> z() const;             ///< of the bias (D.3); nothing without a noise
};

TraceDiscrepancy compare(const Trace& data, const RunTrace& run);

/// In what a person reads a column of this unit, and the factor to it.
struct ShownUnit {
  double factor;
  std::string symbol;
};
ShownUnit shown_in(const std::string& unit, const UnitSystem& units);

/// "cuff: fluid.outlet.pressure is 5.1 mmHg too low on average (4.2 sigma), 6.3 off in root mean square"
std::string sentence_of(const TraceDiscrepancy& trace, const UnitSystem& units);

}  // namespace tether
