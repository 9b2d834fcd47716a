#pragma once

#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// Smooths by pairs of a shrinking and a swelling step (Taubin 1995), which keep shapes longer than some ten edges;
/// rims stay. Returns by what fraction the volume changed.
double smooth(RawSurface& surface, int pairs);

}  // namespace tether
