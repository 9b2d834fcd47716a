#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"
#include "diagnosis/results/missing_force.hpp"

/// The law that a force of unknown origin may follow. (D.14)
namespace tether {

/// What happens where the force acts, at the same moments: means over a region of the wall.
struct LocalMotion {
  VectorXd displacement;  ///< along the outward normal [length]
  VectorXd velocity;      ///< [length/time]
  VectorXd acceleration;  ///< [length/time^2]
  VectorXd pressure;      ///< of the blood beyond that of the image [pressure]
};

/// Chooses the terms that a force needs from 1, un, vn, acceleration, p, un |un|, un^3 and vn |vn|, one at a time, as
/// long as the BIC falls by 6. force, deviation: at the moments of `motion` [n]; deviations weight the moments, their
/// common size does not matter. correlated: how many neighbouring moments amount to one. (D.14)
ForceLaw law_of(const VectorXd& force, const VectorXd& deviation, const LocalMotion& motion, double correlated);

}  // namespace tether
