#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/supports/support.hpp"

namespace tether {

/// All that acts on the wall's outer surface and rings: what holds, what loads, and what replaces a clamp. A new one:
/// one file, its name in the two lists of registry.cpp.
std::span<const Registered<Support>> surface_effects();

/// Those that hold the wall.
std::span<const Registered<Support>> supports();

}  // namespace tether
