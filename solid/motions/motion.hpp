#pragma once

#include <functional>

#include "common/base/types.hpp"

namespace tether {

/// A displacement that is affine in the imaged position x: that of tissue that shifts, or turns as a rigid body.
struct AffineDisplacement {
  Vec3 offset = Vec3::Zero();    ///< [length]
  Mat3 gradient = Mat3::Zero();  ///< a rotation less the identity

  Vec3 at(const Vec3& x) const { return offset + gradient * x; }
  AffineDisplacement& operator+=(const AffineDisplacement& other) {
    offset += other.offset;
    gradient += other.gradient;
    return *this;
  }
  friend AffineDisplacement operator*(double factor, const AffineDisplacement& d) {
    return {factor * d.offset, factor * d.gradient};
  }
};

/// Displacement of the tissue to which the wall is tied, over time: the heart's motion y_b(t), zero at t = 0.
using TissueMotion = std::function<AffineDisplacement(double time)>;

/// How the tissue moves that holds a part of the wall: y_b in (S.4). One file each, listed in registry.cpp.
class MotionLaw {
 public:
  virtual ~MotionLaw() = default;
  /// y_b [length], zero at t = 0; `measured`: the motion that the case gives in a file, if the law asks for one.
  virtual AffineDisplacement at(double time, const TissueMotion& measured) const = 0;
};

}  // namespace tether
