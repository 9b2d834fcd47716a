#pragma once

#include <string>

#include "solid/elements/wall_elements.hpp"

namespace tether {

struct StressFreeResult {
  bool converged = false;
  double reached = 0;   ///< share of the pressure for which there is such a wall
  std::string failure;  ///< of the next step of pressure, the smallest that was tried
  int iterations = 0;
  double residual = 0;  ///< last correction over the vessel's size: half the smallest side of its bounding box
  Points positions;     ///< of the wall without stress, one column a node
};

/// The stress-free wall that, inflated by `pressure`, takes the imaged shape: backward displacement (Bols et al. 2013,
/// J. Comput. Appl. Math.) with tangent steps and Anderson's acceleration, X <- X - K(X)^-1 (f_pressure -
/// f_int(x_imaged; X)) until the imaged shape is in equilibrium; in increments of pressure, which the tension of the
/// one before makes stable (S.12). `fixed`: clamped unknowns; `share`: of the wall's nodes; without any there is no
/// such shape, since nothing carries what pressure exerts along a bent vessel, and none is sought. Supports exert
/// nothing at the imaged shape. `tolerance`: of the last correction, over the vessel's size. Not converging is a
/// result.
StressFreeResult stress_free_configuration(const WallMesh& mesh, const Material& material, double pressure,
                                           const std::vector<int>& fixed, const Share& share, double tolerance = 1e-9);

/// Nodal forces of a uniform pressure on the interface at positions x, 3 x nodes of the wall.
VectorXd uniform_pressure_forces(const WallMesh& mesh, const Points& x, double pressure);

}  // namespace tether
