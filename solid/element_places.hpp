#pragma once

#include <optional>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "solid/elements/wall_local.hpp"

namespace tether {

/// Where the wall's elements are.
struct ElementPlaces {
  std::vector<ElementPlace> of_elements;
  /// What each zone has of an element that several share, by mixture: number `zone` less the number of zones.
  std::vector<std::vector<double>> mixtures;
};

/// Each element, prism or tetrahedron, takes after the triangle of the outer wall nearest to it. zones: what the outer
/// wall is divided into; along: a number at each node that grows along the vessel (S.15), or none.
ElementPlaces element_places(const WallMesh& mesh, const std::vector<Patch>& zones, const VectorXd& along);

}  // namespace tether
