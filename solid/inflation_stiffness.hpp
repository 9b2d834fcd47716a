#pragma once

#include "solid/elements/wall_elements.hpp"

namespace tether {

/// What the wall opposes to inflation, pressure over outward displacement: E h/((1 - nu^2) R^2) with the lumen's mean
/// radius R and the mean thickness h [pressure/length].
double inflation_stiffness(const WallMesh& mesh, const WallElements& wall, const Material& material);

}  // namespace tether
