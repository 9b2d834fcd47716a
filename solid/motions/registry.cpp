#include "solid/motions/registry.hpp"

namespace tether {

std::span<const Registered<MotionLaw>> motions() {
  static const Registered<MotionLaw> all[] = {breathing, measured_motion};
  return all;
}

}  // namespace tether
