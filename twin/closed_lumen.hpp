#pragma once

#include "observation_manager/measurements/signed_surface.hpp"

namespace tether {

/// A lumen whose open ends are drawn out straight by `margin` and closed, as an image shows a vessel that goes on
/// behind the model's ends. Triangles of the lumen itself come first. Throws InputError where an end's rim forks.
TriangleSurface closed_lumen(const TriangleSurface& lumen, double margin);

/// A surface through the same points that is round between them, as a vessel is: each triangle becomes four, with new
/// points at seeded places of the cubic curves that keep the normals at both ends of an edge (T.4).
TriangleSurface rounded(const TriangleSurface& surface, std::uint64_t seed);

}  // namespace tether
