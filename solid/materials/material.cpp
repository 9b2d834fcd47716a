#include "solid/materials/material.hpp"

#include <cmath>

namespace tether {
namespace {

/// C = 1 + 2 E, its invariants, and the derivatives of the invariants by E as stress-like six-vectors.
struct Kinematics {
  double i1, i2, j;
  Voigt inverse;                  ///< C^-1
  Eigen::Matrix<double, 6, 3> g;  ///< columns dI1/dE = 2 1, dI2/dE = 2 (I1 1 - C), dJ/dE = J C^-1
};

Kinematics kinematics(const Voigt& e) {
  const double c11 = 1 + 2 * e[0], c22 = 1 + 2 * e[1], c33 = 1 + 2 * e[2], c12 = e[3], c23 = e[4], c13 = e[5];
  const double m11 = c22 * c33 - c23 * c23, m22 = c11 * c33 - c13 * c13, m33 = c11 * c22 - c12 * c12;
  const double m12 = c13 * c23 - c12 * c33, m23 = c12 * c13 - c11 * c23, m13 = c12 * c23 - c13 * c22;
  const double det = c11 * m11 + c12 * m12 + c13 * m13;
  Kinematics k;
  k.i1 = c11 + c22 + c33;
  k.i2 = m11 + m22 + m33;
  k.j = std::sqrt(det);
  k.inverse << m11, m22, m33, m12, m23, m13;
  k.inverse /= det;
  k.g.col(0) << 2, 2, 2, 0, 0, 0;
  k.g.col(1) << 2 * (k.i1 - c11), 2 * (k.i1 - c22), 2 * (k.i1 - c33), -2 * c12, -2 * c23, -2 * c13;
  k.g.col(2) = k.j * k.inverse;
  return k;
}

/// d2I2/dE2 = 4 (1 x 1 - identity).
void add_second_of_i2(Voigt66& tangent, double factor) {
  tangent.topLeftCorner<3, 3>().array() += 4 * factor;
  tangent.diagonal().head<3>().array() -= 4 * factor;
  tangent.diagonal().tail<3>().array() -= 2 * factor;
}

/// d2J/dE2 = J (C^-1 x C^-1 - 2 C^-1 o C^-1), (A o A)_ijkl = (A_ik A_jl + A_il A_jk)/2.
void add_second_of_j(Voigt66& tangent, const Kinematics& k, double factor) {
  constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  const Voigt& c = k.inverse;
  const double a[3][3] = {{c[0], c[3], c[5]}, {c[3], c[1], c[4]}, {c[5], c[4], c[2]}};
  const double f = factor * k.j;
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n) {
      const int i = row[m], j = column[m], p = row[n], q = column[n];
      tangent(m, n) += f * (c[m] * c[n] - a[i][p] * a[j][q] - a[i][q] * a[j][p]);
    }
}

/// The symmetric tensor of a strain-like six-vector (with 2 E12 ...).
Mat3 strain_tensor(const Voigt& e) {
  Mat3 result;
  result << e[0], e[3] / 2, e[5] / 2, e[3] / 2, e[1], e[4] / 2, e[5] / 2, e[4] / 2, e[2];
  return result;
}

/// d . (d2I2/dE2 d)
double second_of_i2(const Voigt& d) {
  const double trace = d.head<3>().sum();
  return 4 * (trace * trace - d.head<3>().squaredNorm()) - 2 * d.tail<3>().squaredNorm();
}

/// d . (d2J/dE2 d) = J ((C^-1 : d)^2 - 2 tr (C^-1 d C^-1 d))
double second_of_j(const Voigt& d, const Kinematics& k) {
  const Voigt& c = k.inverse;
  Mat3 inverse;
  inverse << c[0], c[3], c[5], c[3], c[1], c[4], c[5], c[4], c[2];
  const Mat3 product = inverse * strain_tensor(d);
  const double trace = product.trace();
  return k.j * (trace * trace - 2 * product.cwiseProduct(product.transpose()).sum());
}

}  // namespace

double energy(const Material& material, const Voigt& strain) {
  const Kinematics k = kinematics(strain);
  return material.potential(k.i1, k.i2, k.j).energy;
}

Voigt stress(const Material& material, const Voigt& strain) {
  const Kinematics k = kinematics(strain);
  return k.g * material.potential(k.i1, k.i2, k.j).first;
}

StressAndTangent stress_and_tangent(const Material& material, const Voigt& strain) {
  const Kinematics k = kinematics(strain);
  const Potential w = material.potential(k.i1, k.i2, k.j);
  StressAndTangent result{k.g * w.first, k.g * w.second * k.g.transpose()};
  if (w.first[1] != 0.0) add_second_of_i2(result.tangent, w.first[1]);
  add_second_of_j(result.tangent, k, w.first[2]);
  return result;
}

ForceAndStiffness along(const Voigt& direction, const Material& material, const Voigt& strain) {
  const Kinematics k = kinematics(strain);
  const Potential w = material.potential(k.i1, k.i2, k.j);
  const Vec3 rates = k.g.transpose() * direction;
  double stiffness = rates.dot(w.second * rates) + w.first[2] * second_of_j(direction, k);
  if (w.first[1] != 0.0) stiffness += w.first[1] * second_of_i2(direction);
  return {w.first.dot(rates), stiffness};
}

}  // namespace tether
