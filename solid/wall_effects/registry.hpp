#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/wall_effects/wall_effect.hpp"

namespace tether {

extern const Registered<WallEffect> stiffness_factor, thickness_factor, axial_tension, fibres;

/// All differences of a part of the wall. A new one: one file, one name above, one name in registry.cpp.
std::span<const Registered<WallEffect>> wall_effects();

}  // namespace tether
