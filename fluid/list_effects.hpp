#pragma once

#include "common/catalogue/effects_list.hpp"
#include "fluid/case.hpp"

namespace tether::fluid {

/// What `fluid --list-effects CASE.yaml` answers: laws of the blood that the case does not have, and that one number
/// leads to from the one that it has.
EffectsList list_effects(const FluidCase& fluid, const UnitSystem& units);

}  // namespace tether::fluid
