#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The first guess of a step's velocity: V0 and a share of the change of V that the step before made. With s the share
/// that would have been nearest in that step it is 2 s - 1, between 0 and 1: where V rings, nothing is extrapolated.
/// (C.1)
class Extrapolation {
 public:
  /// The change to begin a step of this size with; empty if there is none to build on: in the first step, in one of
  /// another size than the step before, in one after a step that failed.
  VectorXd begin(double dt);
  /// The step has converged, and changed V by so much [length/time].
  void end(VectorXd change);

  /// For a checkpoint.
  std::vector<double> packed() const;
  void unpack(const double* begin, const double* end);

 private:
  VectorXd change_;   ///< of the last step that ended; empty if the last one begun has another size
  double share_ = 0;  ///< of it that the next step begins with
  double dt_ = 0;     ///< of the last step begun
  bool ended_ = false;
};

}  // namespace tether
