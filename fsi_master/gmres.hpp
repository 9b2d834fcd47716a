#pragma once

#include <Eigen/Householder>
#include <Eigen/Jacobi>

#include <vector>

#include "common/base/types.hpp"
#include "common/linalg/krylov.hpp"

namespace tether {

/// GMRES without restart or preconditioner for `apply` (VectorXd -> VectorXd), from x = 0: adds the solution to x.
/// Stops when |residual| is below `target`. Arnoldi by modified Gram-Schmidt, least squares by Givens rotations.
template <class Apply>
KrylovResult gmres(const Apply& apply, const VectorXd& residual, VectorXd& x, double target, int max_iterations) {
  const double first = residual.norm();
  KrylovResult result{first <= target, 0, first > 0 ? 1.0 : 0.0};
  if (result.converged || !std::isfinite(first)) return result;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(max_iterations + 1, max_iterations);
  VectorXd g = VectorXd::Zero(max_iterations + 1);
  std::vector<VectorXd> basis{residual / first};
  std::vector<Eigen::JacobiRotation<double>> rotations;
  g(0) = first;
  while (!result.converged && result.iterations < max_iterations) {
    const int k = result.iterations++;
    VectorXd w = apply(basis.back());
    for (int i = 0; i <= k; ++i) {
      H(i, k) = w.dot(basis[i]);
      w -= H(i, k) * basis[i];
    }
    const double rest = w.norm();
    H(k + 1, k) = rest;
    for (int i = 0; i < k; ++i) H.col(k).applyOnTheLeft(i, i + 1, rotations[i]);
    rotations.emplace_back().makeGivens(H(k, k), H(k + 1, k));
    rotations.back() = rotations.back().adjoint();
    H.col(k).applyOnTheLeft(k, k + 1, rotations.back());
    g.applyOnTheLeft(k, k + 1, rotations.back());
    result.residual = std::abs(g(k + 1)) / first;
    result.converged = std::abs(g(k + 1)) <= target;
    if (!std::isfinite(rest) || rest == 0.0) break;
    basis.push_back(w / rest);
  }
  const int n = result.iterations;
  const VectorXd y = H.topLeftCorner(n, n).template triangularView<Eigen::Upper>().solve(g.head(n));
  for (int i = 0; i < n; ++i) x += y(i) * basis[i];
  return result;
}

}  // namespace tether
