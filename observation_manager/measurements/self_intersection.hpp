#pragma once

#include <vector>

#include "observation_manager/measurements/signed_surface.hpp"

namespace tether {

/// For each triangle whether another passes through it. Neighbours count if they cross away from what they share.
std::vector<bool> self_intersections(const TriangleSurface& surface);

}  // namespace tether
