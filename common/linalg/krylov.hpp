#pragma once

#include <cmath>

#include "common/base/types.hpp"

namespace tether {

/// How an iterative solve ended. Not converging is a result, never an exception.
struct KrylovResult {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;  ///< relative to the first
};

/// Conjugate gradients for symmetric positive definite `apply`, preconditioned by `precondition` (both VectorXd ->
/// VectorXd). Starts from x; stops when sqrt(r' M r) has fallen by `tolerance` or below `floor`.
template <class Apply, class Precondition>
KrylovResult conjugate_gradients(const Apply& apply, const Precondition& precondition, VectorXd residual, VectorXd& x,
                                 double tolerance, int max_iterations, double floor = 0.0) {
  VectorXd z = precondition(residual), direction = z;
  double rho = residual.dot(z);
  const double first = std::sqrt(std::max(rho, 0.0));
  KrylovResult result{first <= floor, 0, first > 0 ? 1.0 : 0.0};
  while (!result.converged && result.iterations < max_iterations) {
    const VectorXd product = apply(direction);
    const double step = rho / direction.dot(product);
    x += step * direction;
    residual -= step * product;
    z = precondition(residual);
    const double rho_new = residual.dot(z);
    ++result.iterations;
    const double norm = std::sqrt(std::max(rho_new, 0.0));
    result.residual = norm / first;
    result.converged = norm <= tolerance * first || norm <= floor;
    if (!std::isfinite(norm)) return result;
    direction = z + (rho_new / rho) * direction;
    rho = rho_new;
  }
  return result;
}

}  // namespace tether
