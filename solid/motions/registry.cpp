#include "solid/motions/registry.hpp"

namespace tether {

std::span<const Registered<Motion>> motions() {
  static const Registered<Motion> all[] = {breathing, measured_motion};
  return all;
}

}  // namespace tether
