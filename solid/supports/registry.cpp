#include "solid/supports/registry.hpp"

namespace tether {

extern const Registered<Support> visco_elastic, normal_visco_elastic, tangential_visco_elastic, contact, stiffening,
    tissue_mass, external_pressure, traction, loose_ring;

std::span<const Registered<Support>> surface_effects() {
  static const Registered<Support> all[] = {visco_elastic, normal_visco_elastic, tangential_visco_elastic, contact,
                                            stiffening,    tissue_mass,          external_pressure,        traction,
                                            loose_ring};
  return all;
}

std::span<const Registered<Support>> supports() {
  static const std::vector<Registered<Support>> holding = [] {
    std::vector<Registered<Support>> list;
    for (const Registered<Support>& effect : surface_effects())
      if (effect.declaration.role == EffectRole::holds) list.push_back(effect);
    return list;
  }();
  return holding;
}

}  // namespace tether
