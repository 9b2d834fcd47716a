#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "common/base/types.hpp"

namespace tether {

/// The lumen of a finished run.
struct RunMotion {
  double start = 0, end = 0;                ///< of the run [time]
  Points imaged;                            ///< one column an interface node [length]
  std::function<Points(double)> positions;  ///< at a time of the run [length]
};

/// Of a finished run, from lumen.motion in its folder. Throws InputError if there is none.
RunMotion stored_motion(const std::filesystem::path& folder);

/// When the run was at the moment that data call `time`: of a periodic series in the last period that the run covers;
/// of one frame that holds at all times (NaN) at the end. Nothing if the run was not there, by more than `tolerance`.
std::optional<double> time_in_run(double time, double period, double start, double end, double tolerance);

}  // namespace tether
