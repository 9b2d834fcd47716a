#pragma once

#include <map>
#include <utility>

#include "vessel/surface/raw_surface.hpp"

/// Edges of triangulated surfaces, and what hangs together by them.
namespace tether {

using Edge = std::pair<int, int>;  ///< the smaller node first

inline Edge edge_of(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

struct EdgeUse {
  int triangle;
  int from, to;  ///< as the triangle runs through it
};

using EdgeUses = std::map<Edge, std::vector<EdgeUse>>;
EdgeUses edges_of(const std::vector<Triangle>& triangles);

/// A number for each triangle: equal where triangles hang together by edges of two triangles. From 0 on.
std::vector<int> patches_of(std::size_t triangles, const EdgeUses& edges);

/// The surface's triangles for which `keep` holds; points that none uses are left out.
RawSurface kept(const RawSurface& surface, const std::vector<bool>& keep);

/// Closed loops of border edges, as the triangles run through them. No point may be of two loops.
std::vector<std::vector<int>> loops_of(const std::vector<Triangle>& triangles);

/// Columns of `points` in the order of `nodes`.
Points points_at(const Points& points, const std::vector<int>& nodes);

/// The middle of a triangle.
Vec3 middle(const RawSurface& surface, std::size_t triangle);

}  // namespace tether
