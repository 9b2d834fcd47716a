#pragma once

#include "vessel/surface/surface.hpp"

namespace tether {

/// How long edges are to be.
struct EdgeLength {
  double least = 0, most = 0;  ///< [cm]
  double per_radius = 0;       ///< of the local radius; 0: `most` everywhere
};

/// Cuts the surface anew into triangles with edges of that length, on the surface as it was; rims of caps stay where
/// they are. radius: of the vessel at each point [cm], used with per_radius.
LabelledSurface remeshed(const LabelledSurface& surface, const EdgeLength& length, const std::vector<double>& radius);

}  // namespace tether
