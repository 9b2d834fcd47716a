#pragma once

#include "solid/elements/wall_elements.hpp"

namespace tether {

/// What makes the imaged wall rest under the image's pressure.
struct InitialStress {
  Points virtual_displacement;  ///< the linear elastic displacement whose stress is the initial stress (S.14)
  Points held;                  ///< forces of the surroundings on the wall's nodes, a dead load [force]
  double held_share = 0;        ///< sum of their magnitudes over that of the pressure's forces
};

/// The stress with which the imaged wall carries `pressure` (S.14): that of a linear elastic wall of this material,
/// displaced from the image by u, with free ends. A thin wall carries pressure by tension, hardly by bending; where its
/// section is not round, tension is not enough, and bending alone would take stresses that no artery has (an ellipse of
/// axes 10 % apart: several times the hoop stress). There the tissue around must take part. So u is found by damped
/// steps
///   u <- u + (K + k M_b)^-1 (f_pressure - K u),   u = 0 at first,
/// k = E h/((1 - nu^2) R^2) the wall's stiffness against inflation, M_b the area of the outer wall: each step halves
/// what tension leaves undone, and bending has hardly begun when it is done. What remains is held by the surroundings,
/// as a dead load, and reported. Elasticity is that around the image: the material's modulus is the incremental one
/// there. The stress does not depend on the modulus.
InitialStress find_initial_stress(const WallMesh& mesh, const Material& material, double pressure, const Share& share);

}  // namespace tether
