#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/supports/support.hpp"

namespace tether {

extern const Registered<Support> visco_elastic, normal_visco_elastic, tangential_visco_elastic, contact, stiffening,
    tissue_mass, external_pressure, traction, loose_ring;

/// What holds the wall, passively. A new one: one file, one name above, one name in registry.cpp.
std::span<const Registered<Support>> supports();

/// All that acts on the wall's outer surface and rings: the supports, the loads, and what replaces a clamp.
std::span<const Registered<Support>> surface_effects();

}  // namespace tether
