#pragma once

#include <array>
#include <vector>

#include "common/base/types.hpp"

/// Who touches whom: faces, edges, rims, connected parts. Only indices, no coordinates.
namespace tether {

using Edge = std::array<int, 2>;

/// The nodes in ascending order: equal for two triangles on the same nodes.
Triangle sorted(Triangle triangle);

/// Two triangles of the quadrilateral a b c d (given around), cut through its smallest node: the rule of
/// split_into_tetrahedra.
std::array<Triangle, 2> split_quadrilateral(int a, int b, int c, int d);

/// Local faces of a tetrahedron of positive volume, each looking outward; face i is opposite to node 3, 2, 0, 1 for i =
/// 0..3.
inline constexpr std::array<Triangle, 4> tetrahedron_faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

/// A face and the element it belongs to.
struct OwnedFace {
  Triangle key;   ///< nodes, ascending
  Triangle face;  ///< nodes in the element's outward order
  int element;
};
/// All four faces of all elements, sorted by key: faces on the same nodes stand side by side.
std::vector<OwnedFace> sorted_faces(const std::vector<Tetrahedron>& tetrahedra);

/// Faces that belong to exactly one tetrahedron, outward if volumes are positive.
std::vector<Triangle> boundary_triangles(const std::vector<Tetrahedron>& tetrahedra);

using Quadrilateral = std::array<int, 4>;
/// Side faces of prisms that no neighbour shares, outward, given around.
std::vector<Quadrilateral> boundary_sides(const std::vector<Prism>& prisms);

/// An edge from its lower to its higher node, and how many triangles run along it that way and back.
struct EdgeUses {
  Edge edge;
  int up = 0, down = 0;
};
/// Each edge once, in ascending order.
std::vector<EdgeUses> edge_uses(const std::vector<Triangle>& triangles);

/// Edges used by one triangle only, in that triangle's direction.
std::vector<Edge> open_edges(const std::vector<Triangle>& triangles);

/// Closed loops of the open edges, each in the direction of its triangles. Throws InputError where a loop forks.
std::vector<std::vector<int>> rims(const std::vector<Triangle>& triangles);

/// A part number for each element, 0 .. parts - 1: elements that share a node are in the same part.
struct Parts {
  std::vector<int> part;
  int count = 0;
};
Parts connected_parts(int node_count, const std::vector<Tetrahedron>& tetrahedra);
Parts connected_parts(int node_count, const std::vector<Triangle>& triangles);

}  // namespace tether
