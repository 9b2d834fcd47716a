#pragma once

#include "common/base/effect.hpp"
#include "common/base/types.hpp"

namespace tether {

/// A point of the wall's outer surface or of an end ring, at the time where the step's equations hold.
struct SupportPoint {
  Vec3 displacement;  ///< from the reference (imaged) position, relative to the tissue's own motion
  Vec3 velocity;
  Vec3 normal;  ///< unit, out of the wall
  Vec3 acceleration = Vec3::Zero();
  Vec3 axial =
      Vec3::Zero();  ///< unit, tangential, along the vessel from its first ring (S.15); only for laws that use it
  Vec3 position = Vec3::Zero();  ///< imaged
  double time = 0;
};

/// What the surroundings exert on the wall there, and how it changes.
struct SupportTraction {
  Vec3 traction = Vec3::Zero();   ///< force per area on the wall [pressure]
  Mat3 stiffness = Mat3::Zero();  ///< - d traction / d displacement, symmetric
  Mat3 damping = Mat3::Zero();    ///< - d traction / d velocity, symmetric
  Mat3 inertia = Mat3::Zero();    ///< - d traction / d acceleration, symmetric
};

/// One way in which the surroundings act on the wall (S.4). One file each, listed in registry.cpp.
class Support {
 public:
  virtual ~Support() = default;
  virtual SupportTraction at(const SupportPoint& point) const = 0;
  /// Whether `at` reads the vessel's direction.
  virtual bool uses_axial() const { return false; }
};

/// Whether an effect stands in place of a ring's clamp: where it is absent the ring does not move.
inline bool replaces_clamp(const EffectDeclaration& effect) {
  return effect.place == Place::ring && effect.role == EffectRole::replaces;
}

}  // namespace tether
