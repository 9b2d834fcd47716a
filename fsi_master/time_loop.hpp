#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fsi_master/coupling.hpp"
#include "fsi_master/observer.hpp"

namespace tether {

/// An attempt that failed, and was repeated with half the step.
struct FailedAttempt {
  double time = 0, dt = 0;  ///< [time]
  std::string cause, seen;  ///< in words; what the coupling saw of it: residuals, where they are largest
};

/// A line each; a cause that is the one before it is not said again.
std::string told(const std::vector<FailedAttempt>& attempts);

/// What one full step found and took, its halved parts included.
struct StepRecord {
  int evaluations = 0, krylov_iterations = 0;  ///< sums over the parts, failed attempts included
  int parts = 0;                               ///< converged time steps: 1, more if it was halved
  double residual = 0;                         ///< (C.3) of the last evaluation
  std::vector<double> fluid, solid;            ///< observables at its end
  std::vector<FailedAttempt> failures;
};

/// Everything that a run needs to continue from the end of a step.
struct Snapshot {
  std::vector<double> fluid, solid;            ///< empty for a code that announces no state
  std::vector<double> displacement, velocity;  ///< y and (y - y_-1)/dt on the interface
  std::string method;                          ///< the coupling method,
  std::vector<double> coupling;                ///< and its memory
};

/// Advances fluid and solid together: prediction, coupling loop, acceptance; a step that fails is repeated in halves.
class TimeLoop {
 public:
  /// `rest`: reference positions of the interface, x0 y0 z0 x1 ...; the run starts there, unmoved.
  TimeLoop(FluidPartner& fluid, SolidPartner& solid, Coupling& coupling, VectorXd rest, int halvings);

  /// From now on steps are corrected by measurements. The observer must outlive the loop.
  void observe(Observer& observer) { observer_ = &observer; }

  /// Step number `step`, from `time` to `time + dt`. Throws StepFailure if even the smallest part fails, with both
  /// codes back at `time`; RunError if a code fails where the other may have gone on, so that they have no time.
  StepRecord advance(std::int64_t step, double time, double dt);

  /// Whether both codes can go on from a state.
  bool keeps_state() const { return fluid_.has_state() && solid_.has_state(); }
  const VectorXd& displacement() const { return y_; }
  Snapshot snapshot();
  void restore(const Snapshot& snapshot);

 private:
  bool attempt(double time, double dt, StepRecord& record);
  bool advance_in_halves(double time, double dt, int level, StepRecord& record);
  CouplingResult solve(const StepStart& start);
  CouplingResult solve_with_drift(StepStart start);
  void finish(const CouplingResult& result, StepRecord& record);
  void end_both(bool accepted, StepRecord& record);
  void correct(double time, double dt);
  std::string seen_by(const CouplingResult& result) const;

  FluidPartner& fluid_;
  SolidPartner& solid_;
  Coupling& coupling_;
  Observer* observer_ = nullptr;
  VectorXd rest_, y_, V_;
  int halvings_;
  std::int64_t step_ = 0;
};

}  // namespace tether
