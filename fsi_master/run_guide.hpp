#pragma once

#include <filesystem>
#include <fstream>

#include "fsi_master/partners.hpp"

namespace tether {

/// What each step of a run changed of the velocities that the coupling solves for, in `coupling.changes` of its folder,
/// single precision: where the same steps of another run of the same case begin (C.1). What a run converges to does not
/// depend on it, but for what the coupling's tolerance leaves open.
class RunGuide {
 public:
  enum class Role { guide, follower };
  /// dt: of the run's steps; parts of steps are neither kept nor guided. A follower of a run that kept nothing is not
  /// guided.
  RunGuide(const std::filesystem::path& folder, Role role, double dt);

  /// What the guide's step changed; empty if that is not known, or this is the guide.
  VectorXd change_in(const StepStart& start);
  /// The step has converged, and changed this [length/time]. Only the guide's is kept.
  void keep(const StepStart& start, const VectorXd& change);

 private:
  std::streamoff place_of(const StepStart& start) const;

  Role role_;
  double dt_;
  std::fstream file_;
  std::int64_t unknowns_ = 0;
};

}  // namespace tether
