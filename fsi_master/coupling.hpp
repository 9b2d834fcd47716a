#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fsi_master/partners.hpp"

namespace tether {

class RunGuide;

/// How hard and how long the coupling loop of one step works.
struct CouplingOptions {
  double tolerance = 1e-6;  ///< of the residual measure (C.3)
  int max_iterations = 30;  ///< evaluations a step
  int reuse = 20;           ///< iqn_ils: earlier steps whose differences are kept
  double size = 1.0;        ///< of the vessel: a residual below 1e-12 of it a step is rest [length]
};

/// How the loop of one step ended. Not converging is a result, never an exception.
struct CouplingResult {
  bool converged = false;
  int evaluations = 0;  ///< of fluid and solid together
  int krylov_iterations = 0;
  std::vector<double> residuals;  ///< (C.3), one an evaluation
  Motion motion;                  ///< what the solid keeps if the step is accepted
  int worst_node = -1;            ///< interface node with the largest residual in the last evaluation
  std::string failure;            ///< why it did not converge
};

/// Solves V = S(F(V)) for the interface velocity V of one step.
class Coupling {
 public:
  virtual ~Coupling() = default;
  virtual std::string name() const = 0;
  /// The solid has begun the step, the fluid is at it: a method that asks the solid first need not wait for the fluid.
  /// Throws StepFailure if one of them gives up.
  virtual CouplingResult solve_step(const StepStart& start, Later<Done> fluid_begins) = 0;
  /// Both have begun it.
  CouplingResult solve_step(const StepStart& start) { return solve_step(start, Later<Done>(Done{})); }
  /// What the method remembers from earlier steps: part of a checkpoint.
  virtual std::vector<double> memory() const { return {}; }
  virtual void set_memory(const std::vector<double>&) {}
  /// From now on steps begin as those of another run, or are kept for others; none: no more. A method that knows no
  /// changes of velocities goes its own way.
  virtual void follow(RunGuide*) {}
};

/// `method`: "newton_krylov", "iqn_ils", or "automatic": Newton-Krylov when both codes announce tangents.
/// Throws InputError if a partner cannot do what is asked for.
std::unique_ptr<Coupling> make_coupling(const std::string& method, FluidPartner& fluid, SolidPartner& solid,
                                        const CouplingOptions& options);

}  // namespace tether
