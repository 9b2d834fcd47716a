#include "solid/supports/registry.hpp"

namespace tether {

std::span<const Registered<Support>> surface_effects() {
  static const Registered<Support> all[] = {visco_elastic, normal_visco_elastic, tangential_visco_elastic, contact,
                                            stiffening, tissue_mass,
                                            // loads
                                            external_pressure, traction,
                                            // in place of a clamp
                                            loose_ring};
  return all;
}

std::span<const Registered<Support>> supports() {
  constexpr std::size_t holding = 6;
  return surface_effects().first(holding);
}

}  // namespace tether
