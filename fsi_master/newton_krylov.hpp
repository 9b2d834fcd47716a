#pragma once

#include "fsi_master/convergence.hpp"
#include "fsi_master/extrapolation.hpp"

namespace tether {

/// Newton on all unknowns of the solid with the fluid eliminated, for a solid that announces operators:
///   r(V) = R' F(R V) + r_solid(V),  (J + R' A R) dV = r,  solved by GMRES, preconditioned by the solid's kept factor.
/// R picks the interface velocities, the first unknowns. One evaluation: one projection solve, one solid residual.
class NewtonKrylov : public Coupling {
 public:
  NewtonKrylov(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options);
  std::string name() const override { return "newton_krylov"; }
  CouplingResult solve_step(const StepStart& start) override;
  std::vector<double> memory() const override;
  void set_memory(const std::vector<double>& values) override;
  void follow(RunGuide* guide) override { extrapolation_.follow(guide); }

 private:
  struct Correction {
    VectorXd dV;
    int iterations = 0;
  };
  Correction correction(const VectorXd& estimate, double target);
  VectorXd tangent_times(const VectorXd& dV);

  FluidPartner& fluid_;
  SolidPartner& solid_;
  CouplingOptions options_;
  Extrapolation extrapolation_;  ///< of all unknowns of the solid
  Eigen::Index size_ = 0;        ///< of V on the interface
};

}  // namespace tether
