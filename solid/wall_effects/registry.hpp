#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/wall_effects/wall_effect.hpp"

namespace tether {

/// All differences of a part of the wall. A new one: one file, its name in the two lists of registry.cpp.
std::span<const Registered<WallEffect>> wall_effects();

}  // namespace tether
