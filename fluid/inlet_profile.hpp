#pragma once

#include <string>

#include "common/base/curve.hpp"
#include "fluid/end_face.hpp"

namespace tether::fluid {

/// How the velocity is spread over an inlet; zero at its rim in all of them. (F.12)
enum class Profile {
  flat,       ///< one velocity at all inner nodes
  parabolic,  ///< the steady developed flow of the face's shape
  womersley,  ///< the oscillating developed flow of each harmonic of the curve; needs a periodic curve
};

/// A function of time that repeats, from `start` on.
struct PeriodicCurve {
  const Curve& curve;
  double period, start;
};

/// "flat", "parabolic" or "womersley". Throws InputError.
Profile profile_named(const std::string& name);

/// A velocity profile of unit flux through one face, as a function of time.
class InletProfile {
 public:
  /// curve: used by Womersley's profile only, whose harmonics keep the proportions and phases they have in it.
  InletProfile(const EndFace& face, Profile kind, const PeriodicCurve& curve, double kinematic_viscosity);

  /// Velocities at the face's nodes (local), into the vessel along the face's mean normal, where the mesh stands now.
  /// Their flux is `flow` to round-off. curve_time: the curve's own clock; gain: what its harmonics are multiplied
  /// with.
  Points velocity(const EndFace& face, double flow, double curve_time, double gain) const;

 private:
  /// Speeds at the face's nodes of all harmonics together.
  VectorXd oscillating(double curve_time) const;

  VectorXd steady_;                      // of unit flux on a flat face
  std::vector<Eigen::VectorXcd> waves_;  // Womersley: speed of harmonic k = 1, 2, ... is Re(waves_[k] exp(i k omega t))
  double omega_ = 0;
};

}  // namespace tether::fluid
