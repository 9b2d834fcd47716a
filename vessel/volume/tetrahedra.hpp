#pragma once

#include <optional>

#include "common/mesh/mesh.hpp"
#include "vessel/surface/surface.hpp"

namespace tether {

/// The lumen filled with tetrahedra that keep every triangle and node of its surface (Gmsh's Delaunay, decision 0101);
/// the surface's nodes come first, in their order. The inlet's opening becomes the inlet, the others outlets, by name.
/// longest_edge: of tetrahedra inside [length]; none: as the surface's. Throws InputError with the place where the
/// surface is open, meets more than itself, or crosses itself.
FluidMesh fill_with_tetrahedra(const LabelledSurface& surface, std::optional<double> longest_edge);

}  // namespace tether
