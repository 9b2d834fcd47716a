#pragma once

#include "fsi_master/convergence.hpp"
#include "fsi_master/newton_memory.hpp"

namespace tether {

/// Newton on all unknowns of the solid with the fluid eliminated, for a solid that announces operators:
///   r(V) = R' F(R V) + r_solid(V),  (J + R' A R) dV = r,  solved by GMRES, preconditioned by the solid's kept factor
/// and what earlier corrections have taught (C.9).
/// R picks the interface velocities, the first unknowns. One evaluation: one projection solve, one solid residual.
class NewtonKrylov : public Coupling {
 public:
  NewtonKrylov(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options);
  std::string name() const override { return "newton_krylov"; }
  CouplingResult solve_step(const StepStart& start, Later<Done> fluid_begins) override;
  std::vector<double> memory() const override;
  void set_memory(const std::vector<double>& values) override;
  void follow(RunGuide* guide) override { memory_.follow(guide); }

 private:
  SolidPartner::Iterate evaluate(const StepStart& start, const VectorXd& dV, VectorXd& V,
                                 const Convergence& convergence, Later<Done>* fluid_begins);
  VectorXd correction(const VectorXd& estimate, double target, Convergence& convergence);
  VectorXd tangent_times(const VectorXd& dV);

  FluidPartner& fluid_;
  SolidPartner& solid_;
  CouplingOptions options_;
  NewtonMemory memory_;    ///< of all unknowns of the solid
  Eigen::Index size_ = 0;  ///< of V on the interface
};

}  // namespace tether
