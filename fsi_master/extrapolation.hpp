#pragma once

#include <vector>

#include "fsi_master/run_guide.hpp"

namespace tether {

/// The first guess of a step's velocity: V0 and a change foreseen from the two changes before, a c1 + b c0, with the
/// numbers a and b that would have been best in the steps before, later ones counting more. Where V rings a is
/// negative. If a share of the last change alone foresaw the last step better, that is taken: with s the share that
/// would have been nearest in that step it is 2 s - 1, between 0 and 1. Beside a guide c are the differences from its
/// changes. (C.1)
class Extrapolation {
 public:
  /// From now on what is foreseen is how the change differs from the guide's; none: the change itself.
  void follow(RunGuide* guide);

  /// The change to begin a step with; empty if there is none to build on: in the first step, in one of another size
  /// than the step before, in one after a step that failed.
  VectorXd begin(const StepStart& start);
  /// The step has converged, and changed V by so much [length/time].
  void end(VectorXd change);

  /// For a checkpoint.
  std::vector<double> packed() const;
  void unpack(const double* begin, const double* end);

 private:
  void forget();
  VectorXd foreseen() const { return uses_both_ ? by_both() : by_share(); }
  VectorXd by_share() const { return share_ * change_; }
  VectorXd by_both() const { return a_ * change_ + b_ * before_; }

  RunGuide* guide_ = nullptr;
  StepStart start_;           ///< of the last step begun
  VectorXd guided_;           ///< the guide's change in it; empty: not known
  VectorXd change_, before_;  ///< of the last step that ended, and of the one before; empty: none of this size
  double share_ = 0;          ///< of the last change
  double a_ = 0, b_ = 0;
  double products_[5] = {};  ///< of changes, faded: c1 c1, c1 c0, c0 c0, c1 c2, c0 c2 with c2 what was to be foreseen
  bool uses_both_ = false;   ///< they foresaw the last change better
  double dt_ = 0;            ///< of the last step begun
  bool ended_ = false;
};

}  // namespace tether
