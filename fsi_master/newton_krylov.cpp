#include "fsi_master/newton_krylov.hpp"

#include "fsi_master/recycled_gmres.hpp"

namespace tether {

NewtonKrylov::NewtonKrylov(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options)
    : fluid_(fluid), solid_(solid), options_(options) {}

CouplingResult NewtonKrylov::solve_step(const StepStart& start, Later<Done> fluid_begins) {
  Convergence convergence(options_, start);
  SolidPartner::Iterate solid;
  VectorXd V = start.velocity, dV = memory_.begin(start), change = dV;
  size_ = V.size();
  if (dV.size() > 0) V += dV.head(size_);
  for (double first = 0; convergence.may_continue();) {
    solid = evaluate(start, dV, V, convergence, convergence.evaluations() == 0 ? &fluid_begins : nullptr);
    const VectorXd estimate = solid_.precondition(solid.residual).get();
    if (convergence.evaluations() == 1) memory_.first_correction_left(estimate.norm() / first);
    if (convergence.reached(V, estimate.head(size_))) break;
    const bool is_first = convergence.evaluations() == 1;
    if (is_first) first = estimate.norm();
    dV = correction(estimate, convergence.linear_target(V, estimate.head(size_), is_first ? memory_.left_of(first) : 0),
                    convergence);
    V += dV.head(size_);
    change = change.size() > 0 ? change + dV : dV;
  }
  if (convergence.is_reached()) memory_.end(std::move(change));
  return std::move(convergence).result(std::move(solid.motion));
}

std::vector<double> NewtonKrylov::memory() const {
  return memory_.packed();
}

void NewtonKrylov::set_memory(const std::vector<double>& values) {
  memory_.unpack(values);
}

/// The residual after `dV`, at V (C.4). It is linear in the load, so that the wall computes its part while the blood
/// does its own, the first time the whole explicit stage. Prescribed motion need not be the predicted one: then V
/// becomes what it is.
SolidPartner::Iterate NewtonKrylov::evaluate(const StepStart& start, const VectorXd& dV, VectorXd& V,
                                             const Convergence& convergence, Later<Done>* fluid_begins) {
  auto of_wall = solid_.residual(dV, VectorXd::Zero(size_));
  if (fluid_begins != nullptr) fluid_begins->get();
  VectorXd load = fluid_.load(start.motion(V)).get();
  SolidPartner::Iterate solid = of_wall.get();
  if (!convergence.is_same(solid.motion.velocity, V)) {
    V = solid.motion.velocity;
    load = fluid_.load(start.motion(V)).get();
  }
  solid.residual.head(size_) += load;
  return solid;
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
VectorXd NewtonKrylov::correction(const VectorXd& estimate, double target, Convergence& convergence) {
  const auto preconditioned = [this](const VectorXd& dV) { return solid_.precondition(tangent_times(dV)).get(); };
  VectorXd dV = VectorXd::Zero(estimate.size());
  convergence.note(recycled_gmres(preconditioned, estimate, dV, target, most_krylov_iterations, memory_.directions()));
  return dV;
}

}  // namespace tether
