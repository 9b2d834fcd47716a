#pragma once

#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// Removes triangles without area, needles and caps of an edge below `length` [cm].
void remove_slivers(Repaired& state, double length);

/// Cuts out triangles that cross others, and closes the surface anew. Throws PlacedError if they are more than a
/// twentieth of the area, or some are left.
void remove_crossings(Repaired& state);

/// Middles of the triangles that cross others.
std::vector<Vec3> crossings_of(const RawSurface& surface);

}  // namespace tether
