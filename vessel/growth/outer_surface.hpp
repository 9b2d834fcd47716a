#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// What a wall grows on.
struct GrowthBase {
  Points points;  ///< [length]
  std::vector<Triangle> triangles;
  Points directions;  ///< of the first attempt, of length one
  Points planes;      ///< a node that must stay in a plane: its normal; else zero
  int layers = 2;     ///< of prisms between the surfaces
};

/// The surface that a wall grows to, node by node.
struct OuterSurface {
  Points points;            ///< [length]
  VectorXd asked;           ///< thickness [length]
  VectorXd thickness;       ///< distance to the base [length]
  VectorXd aim;             ///< what was aimed at: less than asked where the wall had no room [length]
  std::vector<char> moved;  ///< whether a node does not lie straight above its own
};

/// How much of the aim is left at a place without room, at a time, and how many times. Long steps are quick, and make
/// the wall thinner than it need be.
struct GrowthSteps {
  double left = 0.75;
  int most = 8;
};
inline constexpr GrowthSteps short_steps{0.92, 24};

/// Places the outer nodes at the asked distance from the base, straight along `directions` where the prisms are fit for
/// it. Elsewhere (in a crotch, where they would fold or the wall become thin) the nodes slide along the outer surface
/// until the prisms are as near to upright ones as can be: what is least is M.2 and the relative error of thickness
/// (M.3). Where that is not enough, or where parts of the outer surface meet, less is aimed at, in steps, and less and
/// less steeply around. Throws InputError with the place where even `least_share` of the asked thickness has no room.
OuterSurface grow_outer_surface(const GrowthBase& base, const VectorXd& asked, const GrowthSteps& steps = {});

constexpr double least_share = 0.3;

}  // namespace tether
