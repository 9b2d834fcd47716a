#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"
#include "common/mesh/mesh.hpp"

namespace tether {

/// Prisms on the nodes of a wall of tetrahedra whose nodes stand in layers, such as a swept or extruded wall cut into
/// tetrahedra. inner: the wall's surface toward the lumen, normals into the wall; its triangles become the prisms' in
/// all layers. (Where a wall was cut from bricks, the diagonals of its other layers may differ from the inner ones:
/// they are cut anew.) A node's partner in the next layer is the nearest of its neighbours there. Verified: no
/// tetrahedron reaches beyond two neighbouring prisms, three of them for a prism, equal volumes within 1e-3. name: of
/// the mesh, for errors. Throws InputError if the wall is not layered.
std::vector<Prism> recombine_prisms(const Points& points, const std::vector<Tetrahedron>& tetrahedra,
                                    const std::vector<Triangle>& inner, const std::string& name);

/// Labels of the tetrahedra's boundary carried over to that of the recombined prisms: a prism's side belongs to the
/// patch that holds three of its nodes, its top to the patch of the same or else the nearest triangle. Sides come cut
/// as split_into_tetrahedra cuts them.
std::vector<Patch> carried_over(const Points& points, const std::vector<Patch>& patches,
                                const std::vector<Prism>& prisms);

}  // namespace tether
