#pragma once

#include "common/linalg/recycling.hpp"
#include "fsi_master/extrapolation.hpp"

namespace tether {

/// What Newton's method has learnt of a vessel from the steps before.
class NewtonMemory {
 public:
  /// The change to begin a step with (C.1). What was learnt of steps of another size is forgotten.
  VectorXd begin(const StepStart& start);
  /// The step has converged, and changed V by so much [length/time].
  void end(VectorXd change) { guess_.end(std::move(change)); }
  void follow(RunGuide* guide) { guess_.follow(guide); }

  /// Of the operator of the corrections (C.9).
  Recycling& directions() { return directions_; }
  /// What a step's first correction will leave of `residual`, because the step is not linear: the share that the last
  /// one left (C.5). 0: not known.
  double left_of(double residual) const { return share_left_ * residual; }
  void first_correction_left(double share) { share_left_ = share; }

  /// For a checkpoint: [dt, share left | directions | first guess | size of the directions].
  std::vector<double> packed() const;
  void unpack(const std::vector<double>& values);

 private:
  Extrapolation guess_;
  Recycling directions_;
  double dt_ = 0, share_left_ = 0;
};

}  // namespace tether
