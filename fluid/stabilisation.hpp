#pragma once

#include <cmath>

namespace tether::fluid {

/// Edge of the regular tetrahedron of this volume: the element's size h in tau.
inline double element_size(double volume) {
  return std::cbrt(8.48528137423857 * volume);
}  // 6 sqrt(2)

/// SUPG's intrinsic time (F.5): tau = [(2/dt)^2 + (2 |a|/h)^2 + (12 nu/h^2)^2]^(-1/2) [time].
/// speed = |a|: of the blood relative to the mesh. nu: kinematic viscosity [length^2/time].
inline double supg_time(double dt, double speed, double h, double nu) {
  const double unsteady = 2 / dt, advective = 2 * speed / h, viscous = 12 * nu / (h * h);
  return 1 / std::sqrt(unsteady * unsteady + advective * advective + viscous * viscous);
}

}  // namespace tether::fluid
