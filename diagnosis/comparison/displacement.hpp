#pragma once

#include <vector>

#include "observation_manager/measurements/lumen_surface.hpp"
#include "observation_manager/measurements/measured_run.hpp"

namespace tether {

/// By how much the lumen of one run lies elsewhere than that of another: root mean square over its area, at the one of
/// these moments at which that is most [length].
double displacement_between(const FinishedMotion& run, const FinishedMotion& other, const LumenSurface& lumen,
                            const std::vector<double>& times);

}  // namespace tether
