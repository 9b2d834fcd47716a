#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/materials/material.hpp"

namespace tether {

extern const Registered<Material> saint_venant_kirchhoff, neo_hookean, mooney_rivlin, ciarlet_geymonat;

/// All hyperelastic laws. A new one: one file, one name above, one name in registry.cpp.
std::span<const Registered<Material>> materials();

}  // namespace tether
