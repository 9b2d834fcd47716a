#pragma once

#include "vessel/centreline/tree.hpp"
#include "vessel/surface/surface.hpp"

namespace tether {

/// The centrelines of a closed surface: cheapest ways through the Voronoi diagram of its wall, an element of a way
/// costing its length over its radius (Antiga et al. 2003), smoothed over a quarter of the radius. The trunk runs from
/// the inlet to the opening of that index; each other opening's branch, the largest first, takes the cheapest way to a
/// line that is there already, and ends on it. spacing: between points [cm]. Throws PlacedError for an opening that no
/// way leads to.
CentrelineTree find_tree(const LabelledSurface& surface, int trunk_outlet, double spacing);

}  // namespace tether
