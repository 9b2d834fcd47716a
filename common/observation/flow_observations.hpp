#pragma once

#include "common/observation/sample.hpp"
#include "common/observation/trace.hpp"
#include "common/observation/velocity_file.hpp"

namespace tether {

/// What a model says of the blood at a time.
struct ModelFlow {
  std::vector<std::string> names;  ///< of columns of timeseries.csv
  std::vector<double> values;      ///< theirs [case's units]
  Points velocities;               ///< at FlowObservations::points; NaN outside the lumen
};

/// A measured pressure, flow or component of velocity beside the model's.
struct FlowSample {
  double difference = 0;  ///< measured minus model's [unit of the quantity]; 0 if excluded
  double deviation = 0;   ///< of the measurement's errors; 0: not stated
  int source = 0;         ///< traces, then velocities, in the order of the case
  Exclusion excluded = Exclusion::none;
};

/// Measurements of the blood.
struct FlowObservations {
  std::vector<Trace> traces;
  std::vector<VelocitySeries> velocities;

  bool empty() const { return traces.empty() && velocities.empty(); }
  /// Where velocities were measured: those of one series after the other [length].
  Points points() const;
  /// One sample a trace, then for each point of each series one a measured component: always as many, in the same
  /// order. What is held out is excluded at all times. Throws InputError for a trace whose observable has no value.
  std::vector<FlowSample> observe(const ModelFlow& model, double time) const;
};

/// Reads and checks them. Throws InputError that names the file, or the field of the case.
FlowObservations load_flow_observations(const ObservationsCase& given, const CaseFile& file);

}  // namespace tether
