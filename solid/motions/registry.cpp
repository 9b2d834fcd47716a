#include "solid/motions/registry.hpp"

namespace tether {

std::span<const Registered<MotionLaw>> motions() {
  static const Registered<MotionLaw> all[] = {breathing, measured_motion, moving_tissue};
  return all;
}

}  // namespace tether
