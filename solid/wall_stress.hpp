#pragma once

#include "solid/elements/wall_elements.hpp"

namespace tether {

/// Cauchy stress of one element as a matrix; `stress`: 11 22 33 12 23 13.
Mat3 stress_tensor(const Voigt& stress);

/// Of Cauchy stresses, one column an element: 11 22 33 12 23 13.
VectorXd von_mises(const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress);

/// The von Mises stress that 99 % of the wall's volume does not exceed: the largest of all is one element's, at a
/// corner or a clamped end, and grows as the mesh is refined. x: positions, one column a node. (S.22)
double peak_stress(const WallElements& wall, const Material& material, const Points& x);

}  // namespace tether
