#include "fsi_master/newton_krylov.hpp"

#include <cmath>

namespace tether {
namespace {

constexpr int most_iterations = 200;  // of conjugate gradients a correction

}  // namespace

NewtonKrylov::NewtonKrylov(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options)
    : fluid_(fluid), solid_(solid), options_(options) {}

CouplingResult NewtonKrylov::solve_step(const StepStart& start) {
  Convergence convergence(options_, start);
  SolidPartner::Iterate solid;
  VectorXd V = start.velocity, dV;
  size_ = V.size();
  while (convergence.may_continue()) {
    solid = solid_.residual(dV, fluid_.load(start.motion(V)).get()).get();  // (C.4)
    if (!convergence.is_same(solid.motion.velocity, V)) {  // prescribed motion need not be the predicted one
      V = solid.motion.velocity;
      solid = solid_.residual({}, fluid_.load(start.motion(V)).get()).get();
    }
    const VectorXd estimate = solid_.precondition(solid.residual).get();
    if (convergence.reached(V, estimate.head(size_))) break;
    Correction solved = correction(solid.residual, estimate, convergence.linear_target(V, estimate.head(size_)));
    convergence.count_krylov(solved.iterations);
    dV = std::move(solved.dV);
    V += dV.head(size_);
  }
  return std::move(convergence).result(std::move(solid.motion));
}

/// (J + R' A R) dV
VectorXd NewtonKrylov::tangent_times(const VectorXd& dV) {
  auto fluid = fluid_.load_change(dV.head(size_));
  auto solid = solid_.product(dV);
  VectorXd product = solid.get();
  product.head(size_) -= fluid.get();  // (C.5)
  return product;
}

/// Conjugate gradients on (C.5) until the estimate R M r of the residual is below `target`. Products at constrained
/// unknowns leave numbers in r that M turns to zero: only M r and r' M r are looked at.
NewtonKrylov::Correction NewtonKrylov::correction(VectorXd residual, VectorXd estimate, double target) {
  Correction solution{VectorXd::Zero(residual.size())};
  VectorXd direction = estimate;
  double rho = residual.dot(estimate);
  while (solution.iterations < most_iterations && estimate.head(size_).norm() > target) {
    const VectorXd product = tangent_times(direction);
    const double step = rho / direction.dot(product);
    solution.dV += step * direction;
    residual -= step * product;
    estimate = solid_.precondition(residual).get();
    const double rho_new = residual.dot(estimate);
    ++solution.iterations;
    if (!std::isfinite(rho_new) || rho_new <= 0) break;
    direction = estimate + (rho_new / rho) * direction;
    rho = rho_new;
  }
  return solution;
}

}  // namespace tether
