#pragma once

#include "solid/elements/wall_elements.hpp"

namespace tether {

/// Mass matrix times an acceleration, for a wall at rest.
inline VectorXd inertia(const WallElements& wall, const Points& rest, const WallMaterial& material,
                        const VectorXd& acceleration) {
  const Points a = acceleration.reshaped(3, rest.cols()), none = Points::Zero(3, rest.cols());
  VectorXd force = VectorXd::Zero(rest.size());
  wall.step_force({rest, none, a, 0.5, 1.0, false}, material, force, nullptr);
  return force;
}

}  // namespace tether
