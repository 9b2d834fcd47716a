#pragma once

#include "observation_manager/measurements/lumen_surface.hpp"

namespace tether {

/// Sum of the two principal curvatures at each node, positive where the lumen is convex: how fast its area grows along
/// the normal, over that area [1/length]. On a rim that of the nearest inner neighbours. (D.17)
VectorXd curvatures(const LumenSurface& lumen);

}  // namespace tether
