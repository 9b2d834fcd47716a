#pragma once

#include <functional>

#include "common/base/types.hpp"

namespace tether {

/// Displacement of the tissue to which the wall is tied, over time: the heart's motion y_b(t).
using TissueMotion = std::function<Vec3(double time)>;

/// How the tissue moves that holds a part of the wall: y_b in (S.4). One file each, listed in registry.cpp.
class MotionLaw {
 public:
  virtual ~MotionLaw() = default;
  /// y_b [length], zero at t = 0; `measured`: the motion that the case gives in a file, if the law asks for one.
  virtual Vec3 at(double time, const TissueMotion& measured) const = 0;
};

}  // namespace tether
