#pragma once

#include "solid/elements/wall_local.hpp"

namespace tether {

/// In what a part of the wall differs from what the case says of all of it. One file each, listed in registry.cpp.
class WallEffect {
 public:
  virtual ~WallEffect() = default;
  virtual void apply(WallLocal& local) const = 0;
  /// Whether it needs the vessel's direction (S.15).
  virtual bool uses_axial() const { return false; }
};

}  // namespace tether
