#pragma once

#include "common/config/overlay.hpp"
#include "fluid/windkessels/outlets_case.hpp"
#include "fluid/windkessels/outlets_result.hpp"
#include "fluid/windkessels/periodic_beat.hpp"

namespace tether {

/// What a fit made: its result, the beat to look at, with absolute pressures [mmHg], flows [ml/s], and the case.
struct OutletsFit {
  FittedOutlets result;
  PeriodicBeat beat;
  std::vector<double> measured_times, measured_pressures;  ///< empty without a curve
  std::optional<Overlay> overlay;                          ///< none without a case
};

/// Throws InputError, with what can be reached, for targets that cannot be.
/// folder: where the overlay will stand, to name the flow's file from there.
OutletsFit fit_outlets(const OutletsCase& asked, const std::filesystem::path& folder);

}  // namespace tether
