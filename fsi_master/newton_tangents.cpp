#include "fsi_master/newton_tangents.hpp"

#include "fsi_master/recycled_gmres.hpp"

namespace tether {

NewtonTangents::NewtonTangents(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options)
    : fluid_(fluid), solid_(solid), options_(options) {}

CouplingResult NewtonTangents::solve_step(const StepStart& start, Later<Done> fluid_begins) {
  fluid_begins.get();
  Convergence convergence(options_, start);
  Motion solid;
  VectorXd V = start.velocity;
  if (const VectorXd change = memory_.begin(start); change.size() > 0) V += change;
  while (convergence.may_continue()) {
    solid = solid_.motion(fluid_.load(start.motion(V)).get()).get();  // (C.2)
    const VectorXd residual = solid.velocity - V;
    if (convergence.reached(V, residual)) break;
    const auto apply = [this](const VectorXd& dV) { return tangent_times(dV); };
    VectorXd dV = VectorXd::Zero(V.size());
    const double target = convergence.linear_target(V, residual);
    convergence.note(recycled_gmres(apply, residual, dV, target, most_krylov_iterations, memory_.directions()));
    V += dV;
  }
  if (convergence.is_reached()) memory_.end(V - start.velocity);
  return std::move(convergence).result(std::move(solid));
}

std::vector<double> NewtonTangents::memory() const {
  return memory_.packed();
}

void NewtonTangents::set_memory(const std::vector<double>& values) {
  memory_.unpack(values);
}

/// (1 - dS dF) dV
VectorXd NewtonTangents::tangent_times(const VectorXd& dV) {
  return dV - solid_.velocity_change(fluid_.load_change(dV).get()).get();  // (C.6)
}

}  // namespace tether
