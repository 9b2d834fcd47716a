#pragma once

#include <memory>

#include "observation_manager/measurements/trace.hpp"
#include "observation_manager/measurements/velocity_series.hpp"

namespace tether {

/// Measurements of the blood: those that need no mesh.
struct FlowObservations {
  std::vector<Trace> traces;
  std::vector<VelocitySeries> velocities;
  std::vector<std::unique_ptr<Measurement>> others;  ///< of kinds that no one but their own file knows

  /// Every source: traces, velocities, others.
  std::vector<const Measurement*> all() const;
  bool empty() const { return all().empty(); }
  /// Where velocities were measured: those of one source after the other [length].
  Points points() const;
};

/// Reads and checks them. Throws InputError that names the file, or the field of the case.
FlowObservations load_flow_observations(const ObservationsCase& given, const CaseFile& file);

}  // namespace tether
