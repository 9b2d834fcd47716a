#pragma once

#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "diagnosis/results/published.hpp"
#include "observation_manager/measurements/measured_run.hpp"

namespace tether {

/// What the table of a run does not say.
struct BeatFacts {
  UnitSystem units;
  std::vector<std::string> columns;  ///< that the run has
  std::vector<std::string> inlets, outlets;
  double imaged = 0;   ///< pressure in the image, at which that of the run is zero [pressure]
  double density = 0;  ///< of the blood; 0: not known [density]
  double period = 0;   ///< of the beat; 0: the whole run [time]
};

/// Of the last beat of a run, in mmHg, %, 1e-3/mmHg, m/s, ml/s, kPa and Pa; those whose columns the run has. (D.22)
std::vector<QuantityFound> beat_quantities(const FinishedMotion& run, const BeatFacts& facts);

}  // namespace tether
