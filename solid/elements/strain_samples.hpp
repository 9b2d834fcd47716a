#pragma once

#include "common/base/types.hpp"

namespace tether {

/// The strains from which an element is made: each is c/2 (g_a . g_b - G_a . G_b), with g = sum over nodes of a
/// derivative times the node's position. Quadratic in the positions, so that differences and midpoints are exact
/// (energy conservation) and second derivatives constant (S.2).
template <int nodes, int count>
struct StrainSamples {
  Eigen::Matrix<double, nodes, count> a =
      Eigen::Matrix<double, nodes, count>::Zero();  ///< derivative by node, one column a sample
  Eigen::Matrix<double, nodes, count> b = Eigen::Matrix<double, nodes, count>::Zero();
  Eigen::Matrix<double, count, 1> factor = Eigen::Matrix<double, count, 1>::Ones();  ///< c: 1 for E_aa, 2 for 2 E_ab

  using Positions = Eigen::Matrix<double, 3, nodes>;
  using Values = Eigen::Matrix<double, count, 1>;
  using Rates = Eigen::Matrix<double, 3 * nodes, count>;

  /// c/2 g_a . g_b of each sample; the strain is the difference to the reference's.
  Values products(const Positions& x) const {
    const Eigen::Matrix<double, 3, count> ga = x * a, gb = x * b;
    return 0.5 * factor.cwiseProduct(ga.cwiseProduct(gb).colwise().sum().transpose());
  }

  /// c/2 |g_a| |g_b|: what a strain of one makes of each sample.
  Values units(const Positions& x) const {
    const Eigen::Matrix<double, 3, count> ga = x * a, gb = x * b;
    return 0.5 * factor.cwiseProduct(ga.colwise().norm().cwiseProduct(gb.colwise().norm()).transpose());
  }

  /// B': derivative of each sample by the nodal positions, one column a sample (S.2).
  Rates rates(const Positions& x) const {
    const Eigen::Matrix<double, 3, count> ga = x * a * (0.5 * factor).asDiagonal(),
                                          gb = x * b * (0.5 * factor).asDiagonal();
    Rates result;
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < nodes; ++i) result.template block<3, 1>(3 * i, k) = a(i, k) * gb.col(k) + b(i, k) * ga.col(k);
    return result;
  }

  /// Second derivative of sum_k stress_k s_k by the positions: a scalar per pair of nodes, times the 3 x 3 identity
  /// (S.3).
  Eigen::Matrix<double, nodes, nodes> geometric(const Values& stress) const {
    const Eigen::Matrix<double, nodes, nodes> half =
        a * (0.5 * factor.cwiseProduct(stress)).asDiagonal() * b.transpose();
    return half + half.transpose();
  }
};

/// Voigt form (2 E12 ...) of the symmetric part of p x q.
inline Eigen::Matrix<double, 6, 1> voigt_dyad(const Vec3& p, const Vec3& q) {
  Eigen::Matrix<double, 6, 1> result;
  result << p[0] * q[0], p[1] * q[1], p[2] * q[2], p[0] * q[1] + p[1] * q[0], p[1] * q[2] + p[2] * q[1],
      p[0] * q[2] + p[2] * q[0];
  return result;
}

}  // namespace tether
