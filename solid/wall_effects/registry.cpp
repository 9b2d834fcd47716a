#include "solid/wall_effects/registry.hpp"

namespace tether {

extern const Registered<WallEffect> stiffness_factor, thickness_factor, axial_tension, fibres;

std::span<const Registered<WallEffect>> wall_effects() {
  static const Registered<WallEffect> all[] = {stiffness_factor, thickness_factor, axial_tension, fibres};
  return all;
}

}  // namespace tether
