#include "common/mesh/topology.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include "common/base/error.hpp"

namespace tether {

Triangle sorted(Triangle triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

std::array<Triangle, 2> split_quadrilateral(int a, int b, int c, int d) {
  if (std::min(a, c) < std::min(b, d)) return {{{a, b, c}, {a, c, d}}};
  return {{{a, b, d}, {b, c, d}}};
}

std::vector<OwnedFace> sorted_faces(const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<OwnedFace> faces;
  faces.reserve(4 * tetrahedra.size());
  for (std::size_t e = 0; e < tetrahedra.size(); ++e)
    for (const Triangle& local : tetrahedron_faces) {
      Triangle face;
      for (std::size_t i = 0; i < 3; ++i) face[i] = tetrahedra[e][static_cast<std::size_t>(local[i])];
      faces.push_back({sorted(face), face, static_cast<int>(e)});
    }
  std::sort(faces.begin(), faces.end(), [](const OwnedFace& a, const OwnedFace& b) {
    return a.key != b.key ? a.key < b.key : a.element < b.element;
  });
  return faces;
}

std::vector<Triangle> boundary_triangles(const std::vector<Tetrahedron>& tetrahedra) {
  const std::vector<OwnedFace> faces = sorted_faces(tetrahedra);
  std::vector<Triangle> boundary;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const bool like_last = i > 0 && faces[i - 1].key == faces[i].key;
    const bool like_next = i + 1 < faces.size() && faces[i + 1].key == faces[i].key;
    if (!like_last && !like_next) boundary.push_back(faces[i].face);
  }
  return boundary;
}

std::vector<Quadrilateral> boundary_sides(const std::vector<Prism>& prisms) {
  std::map<Quadrilateral, std::pair<Quadrilateral, int>> uses;
  for (const Prism& p : prisms)
    for (const Quadrilateral& side :
         {Quadrilateral{p[0], p[1], p[4], p[3]}, {p[1], p[2], p[5], p[4]}, {p[2], p[0], p[3], p[5]}}) {
      Quadrilateral key = side;
      std::sort(key.begin(), key.end());
      auto& [outward, count] = uses[key];
      outward = side;
      ++count;
    }
  std::vector<Quadrilateral> sides;
  for (const auto& [key, use] : uses)
    if (use.second == 1) sides.push_back(use.first);
  return sides;
}

std::vector<Edge> open_edges(const std::vector<Triangle>& triangles) {
  // An edge as one number, for speed: its lower node, its upper one, and in the last bit whether it runs upward.
  std::vector<std::uint64_t> uses;
  uses.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
      uses.push_back(static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high) << 1 |
                     static_cast<std::uint64_t>(t[i] == low));
    }
  std::sort(uses.begin(), uses.end());
  std::vector<Edge> open;
  for (auto first = uses.begin(), last = first; first != uses.end(); first = last) {
    last = std::find_if(first, uses.end(), [&](std::uint64_t use) { return use >> 1 != *first >> 1; });
    if (last - first > 1) continue;
    const auto low = static_cast<int>(*first >> 32), high = static_cast<int>(*first >> 1 & 0x7fffffff);
    open.push_back((*first & 1) != 0 ? Edge{low, high} : Edge{high, low});
  }
  return open;
}

std::vector<std::vector<int>> rims(const std::vector<Triangle>& triangles) {
  std::map<int, int> next;
  for (const Edge& edge : open_edges(triangles))
    if (!next.emplace(edge[0], edge[1]).second)
      throw input_error("surface: its open edge forks at node {}: an edge of a surface must be a simple closed loop",
                        edge[0]);
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int>& loop = loops.emplace_back();
    int node = next.begin()->first;
    for (auto edge = next.find(node); edge != next.end(); edge = next.find(node)) {
      loop.push_back(node);
      node = edge->second;
      next.erase(edge);
    }
  }
  return loops;
}

namespace {

/// Joined sets of nodes; `root` names a node's set.
class Sets {
 public:
  explicit Sets(int size) : parent_(static_cast<std::size_t>(size)) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int node) {
    while (parent(node) != node) node = parent(node) = parent(parent(node));
    return node;
  }
  void join(int a, int b) { parent(root(a)) = root(b); }

 private:
  int& parent(int node) { return parent_[static_cast<std::size_t>(node)]; }
  std::vector<int> parent_;
};

template <class Element>
Parts parts_of(int node_count, const std::vector<Element>& elements) {
  Sets sets(node_count);
  for (const Element& element : elements)
    for (const int node : element) sets.join(element[0], node);
  Parts parts;
  std::map<int, int> number;
  for (const Element& element : elements)
    parts.part.push_back(number.emplace(sets.root(element[0]), static_cast<int>(number.size())).first->second);
  parts.count = static_cast<int>(number.size());
  return parts;
}

}  // namespace

Parts connected_parts(int node_count, const std::vector<Tetrahedron>& tetrahedra) {
  return parts_of(node_count, tetrahedra);
}
Parts connected_parts(int node_count, const std::vector<Triangle>& triangles) {
  return parts_of(node_count, triangles);
}

}  // namespace tether
