#pragma once

#include <vector>

#include "common/mesh/mesh.hpp"
#include "solid/local_effect.hpp"

namespace tether {

/// A part of the outer wall that is alike: of one region, between two places along the vessel, toward a neighbour or
/// none that an effect names, within some of the balls that effects are limited to and beyond the others.
struct WallZone {
  Patch patch;
  int region;     ///< number of the outer wall's patch
  Extent extent;  ///< without a ball
  std::vector<Ball> within = {};
};

/// The regions, cut where an effect of theirs begins or ends. along: a number at each node that grows along the vessel
/// from 0 to 1 (S.15); may be empty if no effect begins or ends along it.
std::vector<WallZone> wall_zones(const WallMesh& mesh, const std::vector<LocalEffect>& effects, const VectorXd& along);

/// Whether the effect acts there.
bool acts_in(const LocalEffect& effect, const WallZone& zone);

}  // namespace tether
