#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/base/configured.hpp"
#include "solid/motions/motion.hpp"

namespace tether {

/// Tissue that moves; it is shared by all that holds the wall there.
struct MovingTissue {
  std::string path;  ///< of its parameters: "solid.effects.breathing"
  Configured<MotionLaw> motion;
  TissueMotion measured;  ///< of laws that ask for it
};

/// What a part of the wall is tied to: y_b in (S.4) is the sum of its own motion and of those of the tissues.
struct Anchor {
  TissueMotion motion = {};  ///< none: it rests
  std::vector<std::shared_ptr<MovingTissue>> tissues = {};

  AffineDisplacement at(double time) const;
  /// Whether it has a motion now: tissues may be absent.
  bool moves() const;
};

/// Nodes that move as given, whatever the forces: those of a ring that the heart carries along, or that is clamped to
/// tissue that moves.
struct DrivenRing {
  std::string name;
  std::vector<int> nodes;
  Anchor anchor;
};

}  // namespace tether
