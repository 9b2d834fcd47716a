#include "solid/supports/registry.hpp"

namespace tether {

std::span<const Registered<Support>> supports() {
  static const Registered<Support> all[] = {visco_elastic, normal_visco_elastic, tangential_visco_elastic};
  return all;
}

}  // namespace tether
