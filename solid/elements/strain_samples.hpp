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

  /// Of positions in T: double, or a Pack of them.
  template <class T>
  using PositionsOf = Eigen::Matrix<T, 3, nodes>;
  template <class T>
  using ValuesOf = Eigen::Matrix<T, count, 1>;
  template <class T>
  using RatesOf = Eigen::Matrix<T, 3 * nodes, count>;
  using Positions = PositionsOf<double>;
  using Values = ValuesOf<double>;
  using Rates = RatesOf<double>;

  /// c/2 g_a . g_b of each sample; the strain is the difference to the reference's.
  template <class T>
  ValuesOf<T> products(const PositionsOf<T>& x) const {
    const Eigen::Matrix<T, 3, count> ga = x.lazyProduct(a), gb = x.lazyProduct(b);
    ValuesOf<T> result;
    for (int k = 0; k < count; ++k) result[k] = 0.5 * factor[k] * ga.col(k).dot(gb.col(k));
    return result;
  }

  /// c/2 |g_a| |g_b|: what a strain of one makes of each sample.
  Values units(const Positions& x) const {
    const Eigen::Matrix<double, 3, count> ga = x * a, gb = x * b;
    return 0.5 * factor.cwiseProduct(ga.colwise().norm().cwiseProduct(gb.colwise().norm()).transpose());
  }

  /// B': derivative of each sample by the nodal positions, one column a sample (S.2).
  template <class T>
  RatesOf<T> rates(const PositionsOf<T>& x) const {
    const Eigen::Matrix<T, 3, count> ga = x.lazyProduct(a), gb = x.lazyProduct(b);
    RatesOf<T> result;
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < nodes; ++i)
        for (int c = 0; c < 3; ++c) result(3 * i + c, k) = 0.5 * factor[k] * (a(i, k) * gb(c, k) + b(i, k) * ga(c, k));
    return result;
  }

  /// Second derivative of sum_k stress_k s_k by the positions: a scalar per pair of nodes, times the 3 x 3 identity
  /// (S.3).
  template <class T>
  Eigen::Matrix<T, nodes, nodes> geometric(const ValuesOf<T>& stress) const {
    Eigen::Matrix<T, nodes, count> scaled;
    for (int k = 0; k < count; ++k) scaled.col(k) = a.col(k) * T(0.5 * factor[k] * stress[k]);
    const Eigen::Matrix<T, nodes, nodes> half = scaled.lazyProduct(b.transpose());
    return half + half.transpose();
  }
};

/// Voigt form (2 E12 ...) of the symmetric part of p x q.
template <class P, class Q>
Eigen::Matrix<typename P::Scalar, 6, 1> voigt_dyad(const Eigen::MatrixBase<P>& p, const Eigen::MatrixBase<Q>& q) {
  Eigen::Matrix<typename P::Scalar, 6, 1> result;
  result << p[0] * q[0], p[1] * q[1], p[2] * q[2], p[0] * q[1] + p[1] * q[0], p[1] * q[2] + p[2] * q[1],
      p[0] * q[2] + p[2] * q[0];
  return result;
}

}  // namespace tether
