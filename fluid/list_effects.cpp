#include "fluid/list_effects.hpp"

#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {

extern const Registered<Rheology> newtonian, shear_thinning;

EffectsList list_effects(const FluidCase& fluid, const UnitSystem& units) {
  EffectsList list;
  if (fluid.rheology.type != newtonian.declaration.name) return list;
  PossibleEffect possible = possible_effect(shear_thinning.declaration, units);
  possible.path = "fluid.rheology";
  std::erase(possible.required, "viscosity");  // which the case has
  list.possible.push_back(std::move(possible));
  return list;
}

}  // namespace tether::fluid
