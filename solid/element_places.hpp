#pragma once

#include <optional>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "solid/elements/wall_local.hpp"

namespace tether {

/// Where each element of the wall is, prism or tetrahedron: it takes after the triangle of the outer wall nearest to
/// it. along: a number at each node that grows along the vessel (S.15), or none.
std::vector<ElementPlace> element_places(const WallMesh& mesh, const VectorXd& along);

}  // namespace tether
