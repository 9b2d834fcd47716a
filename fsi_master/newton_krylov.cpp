#include "fsi_master/newton_krylov.hpp"

#include "fsi_master/gmres.hpp"

namespace tether {

NewtonKrylov::NewtonKrylov(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options)
    : fluid_(fluid), solid_(solid), options_(options) {}

CouplingResult NewtonKrylov::solve_step(const StepStart& start) {
  Convergence convergence(options_, start);
  SolidPartner::Iterate solid;
  VectorXd V = start.velocity, dV = extrapolation_.begin(start), change = dV;
  size_ = V.size();
  if (dV.size() > 0) V += dV.head(size_);
  while (convergence.may_continue()) {
    solid = solid_.residual(dV, fluid_.load(start.motion(V)).get()).get();  // (C.4)
    if (!convergence.is_same(solid.motion.velocity, V)) {  // prescribed motion need not be the predicted one
      V = solid.motion.velocity;
      solid = solid_.residual({}, fluid_.load(start.motion(V)).get()).get();
    }
    const VectorXd estimate = solid_.precondition(solid.residual).get();
    if (convergence.reached(V, estimate.head(size_))) break;
    Correction solved = correction(estimate, convergence.linear_target(V, estimate.head(size_)));
    convergence.count_krylov(solved.iterations);
    dV = std::move(solved.dV);
    V += dV.head(size_);
    change = change.size() > 0 ? change + dV : dV;
  }
  if (convergence.is_reached()) extrapolation_.end(std::move(change));
  return std::move(convergence).result(std::move(solid.motion));
}

std::vector<double> NewtonKrylov::memory() const {
  return extrapolation_.packed();
}

void NewtonKrylov::set_memory(const std::vector<double>& values) {
  extrapolation_.unpack(values.data(), values.data() + values.size());
}

/// (J + R' A R) dV
VectorXd NewtonKrylov::tangent_times(const VectorXd& dV) {
  auto fluid = fluid_.load_change(dV.head(size_));
  auto solid = solid_.product(dV);
  VectorXd product = solid.get();
  product.head(size_) -= fluid.get();  // (C.5)
  return product;
}

/// GMRES on M (J + R' A R) dV = M r until |M r| is below `target`: nearly symmetric, but not quite, as the pressure
/// follows the wall. Products at constrained unknowns leave numbers that M turns to zero.
NewtonKrylov::Correction NewtonKrylov::correction(const VectorXd& estimate, double target) {
  Correction solution{VectorXd::Zero(estimate.size())};
  const auto preconditioned = [this](const VectorXd& dV) { return solid_.precondition(tangent_times(dV)).get(); };
  solution.iterations = gmres(preconditioned, estimate, solution.dV, target, most_krylov_iterations).iterations;
  return solution;
}

}  // namespace tether
