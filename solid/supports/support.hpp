#pragma once

#include "common/base/types.hpp"

namespace tether {

/// A point of the wall's outer surface or of an end ring, at the time where the step's equations hold.
struct SupportPoint {
  Vec3 displacement;  ///< from the reference (imaged) position
  Vec3 velocity;
  Vec3 normal;        ///< unit, out of the wall
};

/// What the surroundings exert on the wall there, and how it changes.
struct SupportTraction {
  Vec3 traction = Vec3::Zero();    ///< force per area on the wall [pressure]
  Mat3 stiffness = Mat3::Zero();   ///< - d traction / d displacement, symmetric positive semi-definite
  Mat3 damping = Mat3::Zero();     ///< - d traction / d velocity, likewise
};

/// One way in which surrounding tissue holds the wall (S.4). One file each, listed in registry.cpp.
class Support {
 public:
  virtual ~Support() = default;
  virtual SupportTraction at(const SupportPoint& point) const = 0;
};

}  // namespace tether
