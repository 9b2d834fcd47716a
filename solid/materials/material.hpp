#pragma once

#include "common/base/types.hpp"
#include "common/linalg/pack.hpp"

namespace tether {

template <class T>
using VoigtOf = Eigen::Matrix<T, 6, 1>;  ///< 11 22 33 12 23 13; strains carry 2 E12, 2 E23, 2 E13
using Voigt = VoigtOf<double>;
using Voigt66 = Eigen::Matrix<double, 6, 6>;

/// Derivatives of an isotropic potential W(I1, I2, J) of C = 1 + 2 E, in the order I1, I2, J. I1 = tr C, I2 = (I1^2 -
/// tr C^2)/2, J^2 = det C.
template <class T>
struct Derivatives {
  Eigen::Matrix<T, 3, 1> first = Eigen::Matrix<T, 3, 1>::Zero();   ///< dW/dI1, dW/dI2, dW/dJ
  Eigen::Matrix<T, 3, 3> second = Eigen::Matrix<T, 3, 3>::Zero();  ///< symmetric
};

/// A hyperelastic law: one file gives its potential, everything else follows.
class Material {
 public:
  virtual ~Material() = default;
  /// W per reference volume [pressure].
  virtual double energy(double i1, double i2, double j) const = 0;
  virtual Derivatives<double> derivatives(double i1, double i2, double j) const = 0;
  virtual Derivatives<Pack> derivatives(const Pack& i1, const Pack& i2, const Pack& j) const = 0;
};

/// What a law derives from: it has an energy, and `template <class T> Derivatives<T> at(T i1, T i2, T j) const`.
template <class Law>
class MaterialOf : public Material {
 public:
  Derivatives<double> derivatives(double i1, double i2, double j) const final { return law().at(i1, i2, j); }
  Derivatives<Pack> derivatives(const Pack& i1, const Pack& i2, const Pack& j) const final {
    return law().at(i1, i2, j);
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
};

/// Second Piola-Kirchhoff stress S = dW/dE (S.1) [pressure] and tangent dS/dE.
template <class T>
struct StressAndTangentOf {
  VoigtOf<T> stress;
  Eigen::Matrix<T, 6, 6> tangent;
};
using StressAndTangent = StressAndTangentOf<double>;

/// d . S and d . (dS/dE d) [pressure]: all that a search along a direction d of strain needs.
template <class T>
struct ForceAndStiffness {
  T force, stiffness;
};

double energy(const Material& material, const Voigt& strain);
Voigt stress(const Material& material, const Voigt& strain);
StressAndTangent stress_and_tangent(const Material& material, const Voigt& strain);
ForceAndStiffness<double> along(const Voigt& direction, const Material& material, const Voigt& strain);

/// The same of four strains at once: T is Pack.
template <class T>
VoigtOf<T> stress(const Material& material, const VoigtOf<T>& strain);
template <class T>
StressAndTangentOf<T> stress_and_tangent(const Material& material, const VoigtOf<T>& strain);
template <class T>
ForceAndStiffness<T> along(const VoigtOf<T>& direction, const Material& material, const VoigtOf<T>& strain);

}  // namespace tether
