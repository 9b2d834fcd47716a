#pragma once

#include "common/linalg/krylov.hpp"
#include "fsi_master/coupling.hpp"

namespace tether {

inline constexpr int most_krylov_iterations = 100;  ///< of GMRES for one correction

/// The record of one coupling loop, and its only judge of convergence. With r = S(F(V)) - V on the interface
///   |r| / max(|V|, |V + r|) <= tolerance                                        (C.3)
/// or rms(r) dt <= 1e-12 of the vessel's size: a system at rest is converged. All methods are measured alike:
/// Newton with operators has r = R M r_solid, which is the same to first order (M about J^-1).
class Convergence {
 public:
  Convergence(const CouplingOptions& options, const StepStart& start);

  bool may_continue() const;
  bool is_reached() const { return result_.converged; }
  /// Notes an evaluation at V; true if it converged.
  bool reached(const VectorXd& V, const VectorXd& residual);
  int evaluations() const { return result_.evaluations; }
  /// A linear solve for a correction has ended. One that did hardly anything ends the loop: the step is too large.
  void note(const KrylovResult& solve);
  /// The length of r to which a linear solve for the correction of V should go [length/time]: a share of what will be
  /// asked for. That is set by |V| after the correction, of which |V| now and r (an added-mass ratio times it) tell.
  /// `left`: what no linear solve will remove; to solve further than a share of that would be in vain.
  double linear_target(const VectorXd& V, const VectorXd& residual, double left = 0) const;
  /// Whether a velocity may be taken for V.
  bool is_same(const VectorXd& velocity, const VectorXd& V) const;
  /// `motion`: of the solid at the last evaluation.
  CouplingResult result(Motion motion) &&;

 private:
  double target(const VectorXd& V, const VectorXd& residual) const;

  const CouplingOptions& options_;
  double floor_;  ///< of |r| [length/time]
  CouplingResult result_;
};

}  // namespace tether
