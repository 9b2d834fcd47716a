#include "solid/materials/material.hpp"

#include <cmath>

namespace tether {
namespace {

using std::sqrt;

/// C = 1 + 2 E, its invariants, and the derivatives of the invariants by E as stress-like six-vectors.
template <class T>
struct Kinematics {
  T i1, i2, j;
  VoigtOf<T> inverse;        ///< C^-1
  Eigen::Matrix<T, 6, 3> g;  ///< columns dI1/dE = 2 1, dI2/dE = 2 (I1 1 - C), dJ/dE = J C^-1
};

template <class T>
Kinematics<T> kinematics(const VoigtOf<T>& e) {
  const T c11 = 1.0 + 2.0 * e[0], c22 = 1.0 + 2.0 * e[1], c33 = 1.0 + 2.0 * e[2], c12 = e[3], c23 = e[4], c13 = e[5];
  const T m11 = c22 * c33 - c23 * c23, m22 = c11 * c33 - c13 * c13, m33 = c11 * c22 - c12 * c12;
  const T m12 = c13 * c23 - c12 * c33, m23 = c12 * c13 - c11 * c23, m13 = c12 * c23 - c13 * c22;
  const T det = c11 * m11 + c12 * m12 + c13 * m13;
  Kinematics<T> k;
  k.i1 = c11 + c22 + c33;
  k.i2 = m11 + m22 + m33;
  k.j = sqrt(det);
  k.inverse << m11, m22, m33, m12, m23, m13;
  k.inverse *= T(1.0) / det;
  k.g.col(0) << 2.0, 2.0, 2.0, 0.0, 0.0, 0.0;
  k.g.col(1) << 2.0 * (k.i1 - c11), 2.0 * (k.i1 - c22), 2.0 * (k.i1 - c33), -2.0 * c12, -2.0 * c23, -2.0 * c13;
  k.g.col(2) = k.j * k.inverse;
  return k;
}

template <class T>
Derivatives<T> derivatives(const Material& material, const Kinematics<T>& k) {
  return material.derivatives(k.i1, k.i2, k.j);
}

/// d2I2/dE2 = 4 (1 x 1 - identity).
template <class T>
void add_second_of_i2(Eigen::Matrix<T, 6, 6>& tangent, const T& factor) {
  tangent.template topLeftCorner<3, 3>().array() += 4.0 * factor;
  tangent.diagonal().template head<3>().array() -= 4.0 * factor;
  tangent.diagonal().template tail<3>().array() -= 2.0 * factor;
}

/// d2J/dE2 = J (C^-1 x C^-1 - 2 C^-1 o C^-1), (A o A)_ijkl = (A_ik A_jl + A_il A_jk)/2.
template <class T>
void add_second_of_j(Eigen::Matrix<T, 6, 6>& tangent, const Kinematics<T>& k, const T& factor) {
  constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  const VoigtOf<T>& c = k.inverse;
  const T a[3][3] = {{c[0], c[3], c[5]}, {c[3], c[1], c[4]}, {c[5], c[4], c[2]}};
  const T f = factor * k.j;
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n) {
      const int i = row[m], j = column[m], p = row[n], q = column[n];
      tangent(m, n) += f * (c[m] * c[n] - a[i][p] * a[j][q] - a[i][q] * a[j][p]);
    }
}

/// d . (d2I2/dE2 d)
template <class T>
T second_of_i2(const VoigtOf<T>& d) {
  const T trace = d[0] + d[1] + d[2];
  return 4.0 * (trace * trace - d[0] * d[0] - d[1] * d[1] - d[2] * d[2]) -
         2.0 * (d[3] * d[3] + d[4] * d[4] + d[5] * d[5]);
}

/// d . (d2J/dE2 d) = J ((C^-1 : d)^2 - 2 tr (C^-1 d C^-1 d))
template <class T>
T second_of_j(const VoigtOf<T>& d, const Kinematics<T>& k) {
  const VoigtOf<T>& c = k.inverse;
  Eigen::Matrix<T, 3, 3> inverse, tensor;
  inverse << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2];
  const T d12 = 0.5 * d[3], d23 = 0.5 * d[4], d13 = 0.5 * d[5];
  tensor << d[0], d12, d13, d12, d[1], d23, d13, d23, d[2];
  const Eigen::Matrix<T, 3, 3> product = inverse.lazyProduct(tensor);
  const T trace = product.trace();
  return k.j * (trace * trace - 2.0 * product.cwiseProduct(product.transpose()).sum());
}

}  // namespace

template <class T>
VoigtOf<T> stress(const Material& material, const VoigtOf<T>& strain) {
  const Kinematics<T> k = kinematics(strain);
  return k.g.lazyProduct(derivatives(material, k).first);
}

template <class T>
StressAndTangentOf<T> stress_and_tangent(const Material& material, const VoigtOf<T>& strain) {
  const Kinematics<T> k = kinematics(strain);
  const Derivatives<T> w = derivatives(material, k);
  const Eigen::Matrix<T, 6, 3> product = k.g.lazyProduct(w.second);
  StressAndTangentOf<T> result{k.g.lazyProduct(w.first), product.lazyProduct(k.g.transpose())};
  add_second_of_i2(result.tangent, w.first[1]);
  add_second_of_j(result.tangent, k, w.first[2]);
  return result;
}

template <class T>
ForceAndStiffness<T> along(const VoigtOf<T>& direction, const Material& material, const VoigtOf<T>& strain) {
  const Kinematics<T> k = kinematics(strain);
  const Derivatives<T> w = derivatives(material, k);
  const Eigen::Matrix<T, 3, 1> rates = k.g.transpose().lazyProduct(direction);
  const Eigen::Matrix<T, 3, 1> product = w.second.lazyProduct(rates);
  return {w.first.dot(rates),
          rates.dot(product) + w.first[2] * second_of_j(direction, k) + w.first[1] * second_of_i2(direction)};
}

double energy(const Material& material, const Voigt& strain) {
  const Kinematics<double> k = kinematics(strain);
  return material.energy(k.i1, k.i2, k.j);
}

Voigt stress(const Material& material, const Voigt& strain) {
  return stress<double>(material, strain);
}

StressAndTangent stress_and_tangent(const Material& material, const Voigt& strain) {
  return stress_and_tangent<double>(material, strain);
}

ForceAndStiffness<double> along(const Voigt& direction, const Material& material, const Voigt& strain) {
  return along<double>(direction, material, strain);
}

template VoigtOf<Pack> stress(const Material&, const VoigtOf<Pack>&);
template StressAndTangentOf<Pack> stress_and_tangent(const Material&, const VoigtOf<Pack>&);
template ForceAndStiffness<Pack> along(const VoigtOf<Pack>&, const Material&, const VoigtOf<Pack>&);

}  // namespace tether
