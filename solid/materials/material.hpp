#pragma once

#include "common/base/types.hpp"

namespace tether {

using Voigt = Eigen::Matrix<double, 6, 1>;  ///< 11 22 33 12 23 13; strains carry 2 E12, 2 E23, 2 E13
using Voigt66 = Eigen::Matrix<double, 6, 6>;

/// An isotropic potential W(I1, I2, J) of C = 1 + 2 E and its derivatives, in the order I1, I2, J. I1 = tr C, I2 =
/// (I1^2 - tr C^2)/2, J^2 = det C.
struct Potential {
  double energy = 0.0;         ///< W per reference volume [pressure]
  Vec3 first = Vec3::Zero();   ///< dW/dI1, dW/dI2, dW/dJ
  Mat3 second = Mat3::Zero();  ///< second derivatives, symmetric
};

/// A hyperelastic law: one file gives its potential, everything else follows.
class Material {
 public:
  virtual ~Material() = default;
  virtual Potential potential(double i1, double i2, double j) const = 0;
};

/// Second Piola-Kirchhoff stress S = dW/dE (S.1) [pressure] and tangent dS/dE.
struct StressAndTangent {
  Voigt stress;
  Voigt66 tangent;
};

/// d . S and d . (dS/dE d) [pressure]: all that a search along a direction d of strain needs.
struct ForceAndStiffness {
  double force, stiffness;
};

double energy(const Material& material, const Voigt& strain);
Voigt stress(const Material& material, const Voigt& strain);
StressAndTangent stress_and_tangent(const Material& material, const Voigt& strain);
ForceAndStiffness along(const Voigt& direction, const Material& material, const Voigt& strain);

}  // namespace tether
