#pragma once

#include <memory>

#include "observation_manager/measurements/error_regions.hpp"
#include "observation_manager/measurements/flow_observations.hpp"
#include "observation_manager/measurements/lumen_series.hpp"

namespace tether {

/// All that was measured of a case.
struct Observations : FlowObservations {
  std::vector<std::unique_ptr<LumenSeries>> lumen;
  std::vector<std::string> flow_notes;  ///< what was found of the velocities
  ErrorRegions regions;                 ///< for which distances are told

  /// Every source, of whatever kind: those of `lumen`, then those of the blood. Its order is that of their numbers.
  std::vector<const Measurement*> all() const;
  /// The samples of all lumen data at a time, sources one after the other.
  std::vector<Sample> observe(const Points& x, double time) const;
  /// What was found and done on loading: "cine_mr: ..."
  std::vector<std::string> notes() const;
  /// A hash of everything: it changes if what was measured does.
  std::uint64_t content() const;
};

/// Reads and checks everything. Throws InputError that names the file, or the field of the case.
Observations load_observations(const ObservationsCase& given, const LumenSurface& lumen, const CaseFile& file);

}  // namespace tether
