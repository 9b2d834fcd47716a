#pragma once

#include <string>
#include <vector>

#include "common/base/configured.hpp"
#include "common/catalogue/extent.hpp"
#include "solid/wall_effects/wall_effect.hpp"

namespace tether {

/// A difference of some regions of the wall from the rest.
struct LocalEffect {
  std::string path;  ///< of its parameters: "solid.effects.plaque"
  Configured<WallEffect> effect;
  std::vector<int> regions;  ///< numbers of the outer wall's patches
  Extent extent = {};
};

}  // namespace tether
