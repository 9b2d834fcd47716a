#pragma once

#include "observation_manager/measurements/contour.hpp"

namespace tether {

/// A place on the model's cut.
struct CutStation {
  SurfacePlace place;
  Vec3 position;
  Vec2 normal;  ///< of the cut, in the plane, out of the lumen
};

/// `count` places in the middle of equal parts of a piece. A closed one is divided from where the ray along e1 from its
/// middle leaves it: places move continuously with the surface, and do not depend on its triangles (O.6).
std::vector<CutStation> stations_along(const CutPiece& piece, const SlicePlane& plane, int count);

}  // namespace tether
