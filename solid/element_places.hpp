#pragma once

#include <optional>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "solid/elements/wall_local.hpp"

namespace tether {

/// Where the wall's elements are.
struct ElementPlaces {
  std::vector<ElementPlace> of_elements;
  /// What each region has of an element that several share, by mixture: number `region` less the number of regions.
  std::vector<std::vector<double>> mixtures;
};

/// Each element, prism or tetrahedron, takes after the triangle of the outer wall nearest to it. along: a number at
/// each node that grows along the vessel (S.15), or none.
ElementPlaces element_places(const WallMesh& mesh, const VectorXd& along);

}  // namespace tether
