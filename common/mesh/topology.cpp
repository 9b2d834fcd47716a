#include "common/mesh/topology.hpp"

#include <algorithm>
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

std::vector<EdgeUses> edge_uses(const std::vector<Triangle>& triangles) {
  // Sides by their lower node, counted first; the few of one node are then put in order by the other.
  struct Side {
    int high;
    bool up;
  };
  const auto each = [&](auto visit) {
    for (const Triangle& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(t[i], t[(i + 1) % 3]);
        visit(static_cast<std::size_t>(low), Side{high, t[i] == low});
      }
  };
  std::vector<std::size_t> start;
  each([&](std::size_t low, const Side&) {
    if (start.size() < low + 2) start.resize(low + 2, 0);
    ++start[low + 1];
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Side> sides(3 * triangles.size());
  std::vector<std::size_t> next = start;
  each([&](std::size_t low, const Side& side) { sides[next[low]++] = side; });
  std::vector<EdgeUses> uses;
  uses.reserve(sides.size() / 2);
  for (std::size_t low = 0; low + 1 < start.size(); ++low) {
    const auto first = sides.begin() + static_cast<std::ptrdiff_t>(start[low]),
               last = sides.begin() + static_cast<std::ptrdiff_t>(start[low + 1]);
    std::sort(first, last, [](const Side& a, const Side& b) { return a.high < b.high; });
    for (auto side = first; side != last; ++side) {
      if (side == first || side->high != (side - 1)->high) uses.push_back({{static_cast<int>(low), side->high}});
      ++(side->up ? uses.back().up : uses.back().down);
    }
  }
  return uses;
}

std::vector<Edge> open_edges(const std::vector<Triangle>& triangles) {
  std::vector<Edge> open;
  for (const auto& [edge, up, down] : edge_uses(triangles))
    if (up + down == 1) open.push_back(up == 1 ? edge : Edge{edge[1], edge[0]});
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
  std::vector<int> number(static_cast<std::size_t>(node_count), -1);
  for (const Element& element : elements) {
    int& part = number[static_cast<std::size_t>(sets.root(element[0]))];
    if (part < 0) part = parts.count++;
    parts.part.push_back(part);
  }
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
