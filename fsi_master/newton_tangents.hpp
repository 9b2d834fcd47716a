#pragma once

#include "fsi_master/convergence.hpp"
#include "fsi_master/newton_memory.hpp"

namespace tether {

/// Newton on the interface for two codes with tangents but no operators:
///   r(V) = S(F(V)) - V,  (1 - dS dF) dV = r,  solved by GMRES.
/// One evaluation: one projection solve, one full solve of the solid. One Krylov iteration: a tangent of each.
class NewtonTangents : public Coupling {
 public:
  NewtonTangents(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options);
  std::string name() const override { return "newton_krylov"; }
  CouplingResult solve_step(const StepStart& start, Later<Done> fluid_begins) override;
  std::vector<double> memory() const override;
  void set_memory(const std::vector<double>& values) override;
  void follow(RunGuide* guide) override { memory_.follow(guide); }

 private:
  VectorXd tangent_times(const VectorXd& dV);

  FluidPartner& fluid_;
  SolidPartner& solid_;
  CouplingOptions options_;
  NewtonMemory memory_;
};

}  // namespace tether
