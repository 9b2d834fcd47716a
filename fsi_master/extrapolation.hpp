#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The first guess of a step's velocity: V0 and the change of V that the step before made, so linear in time. (C.1)
class Extrapolation {
 public:
  /// The change to begin a step of this size with; empty if it is none to build on: the first, one of another size than
  /// the step before, one after a step that failed.
  VectorXd begin(double dt);
  /// The step has converged, and changed V by so much [length/time].
  void end(VectorXd change) { change_ = std::move(change); }

  /// For a checkpoint.
  std::vector<double> packed() const;
  void unpack(const double* begin, const double* end);

 private:
  VectorXd change_;  ///< of the last step; empty while one is under way
  double dt_ = 0;    ///< of the last step begun
};

}  // namespace tether
