#include "solid/materials/registry.hpp"

namespace tether {

std::span<const Registered<Material>> materials() {
  static const Registered<Material> all[] = {saint_venant_kirchhoff, neo_hookean, mooney_rivlin, ciarlet_geymonat};
  return all;
}

}  // namespace tether
