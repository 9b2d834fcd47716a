#pragma once

#include <optional>
#include <vector>

#include "solid/motions/motion.hpp"

namespace tether {

/// Where a body was at some times: its centre, and its turn since the first of them as axis times angle [rad].
struct Poses {
  std::vector<double> times;  ///< ascending
  Points centres, turns;      ///< [length], [rad]; one column a time
  double misfit = 0;          ///< of points that were fitted: root mean square distance from a rigid motion [length]
};

/// Poses of marked points of a body: the rotations that fit best (Kabsch; Umeyama 1991), about the points' mean.
/// marks: for each time the same points in the same order, at least three that are not on a line.
/// Throws InputError for points on a line.
Poses poses_of(std::vector<double> times, const std::vector<Points>& marks);

/// How poses become a motion in time.
struct MotionShape {
  std::optional<double> period = {};  ///< the motion repeats
  std::optional<int> harmonics = {};  ///< of a Fourier series fitted to the poses; none: linear between them
  bool turns = true;                  ///< false: only the centre's motion is followed
};

/// From the frame of the data to that of the model: directions are turned by `rotation`, and the body's centre at t = 0
/// is put at `centre`.
struct Placement {
  Mat3 rotation = Mat3::Identity();
  std::optional<Vec3> centre;  ///< none: where the data have it
};

/// A rigid body's displacement since t = 0 (S.23).
class RigidMotion {
 public:
  /// Throws InputError if the harmonics need more poses, or the body turns by more than a right angle: then the points
  /// are hardly the same ones at all times.
  RigidMotion(const Poses& poses, const MotionShape& shape, const Placement& placement = {});

  AffineDisplacement operator()(double time) const;

  /// Largest way of the centre from where it is at t = 0 [length], over the times of the poses.
  double largest_way() const { return largest_way_; }
  /// Of the points from rigid poses, root mean square [length]; 0 if poses were given.
  double point_misfit() const { return point_misfit_; }
  /// Root mean square of what the Fourier series leaves of the centres [length] and of the turns [rad]; 0 without.
  double centre_residual() const { return centre_residual_; }
  double turn_residual() const { return turn_residual_; }

 private:
  using Path = std::function<Vec3(double time)>;
  Path smooth(const std::vector<double>& times, const Points& values, const MotionShape& shape, double& residual) const;

  Path centre_, turn_;
  Vec3 start_;         // centre at t = 0, in the frame of the data
  Mat3 start_turned_;  // rotation at t = 0
  Placement placement_;
  double largest_way_ = 0, point_misfit_, centre_residual_ = 0, turn_residual_ = 0;
};

}  // namespace tether
