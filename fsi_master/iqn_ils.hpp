#pragma once

#include "fsi_master/convergence.hpp"
#include "fsi_master/difference_columns.hpp"
#include "fsi_master/extrapolation.hpp"

namespace tether {

/// Interface quasi-Newton with an inverse Jacobian from least squares, for black boxes (Degroote, Bathe and Vierendeels
/// 2009): x~ = S(F(x)), r = x~ - x, next x = x~ + dX c with c = argmin |r + dR c|.
class IqnIls : public Coupling {
 public:
  IqnIls(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options);
  std::string name() const override { return "iqn_ils"; }
  CouplingResult solve_step(const StepStart& start, Later<Done> fluid_begins) override;
  std::vector<double> memory() const override;
  void set_memory(const std::vector<double>& values) override;

 private:
  FluidPartner& fluid_;
  SolidPartner& solid_;
  CouplingOptions options_;
  DifferenceColumns columns_;
  Extrapolation extrapolation_;
  double dt_ = 0;  ///< of the steps that the columns come from
};

}  // namespace tether
