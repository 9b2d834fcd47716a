#include "common/mesh/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace tether {

std::vector<int> nodes_of(const std::vector<Triangle>& triangles) {
  std::vector<int> nodes;
  nodes.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) nodes.insert(nodes.end(), t.begin(), t.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

double signed_volume(const Points& points, const Tetrahedron& tetrahedron) {
  const Vec3 origin = points.col(tetrahedron[0]);
  const Vec3 a = points.col(tetrahedron[1]) - origin, b = points.col(tetrahedron[2]) - origin;
  return a.cross(b).dot(points.col(tetrahedron[3]) - origin) / 6.0;
}

namespace {

/// The six rotations of a prism onto itself, by the vertex that comes to position 0 (Dompierre et al. 1999).
constexpr std::array<Prism, 6> rotations{{{0, 1, 2, 3, 4, 5},
                                          {1, 2, 0, 4, 5, 3},
                                          {2, 0, 1, 5, 3, 4},
                                          {3, 5, 4, 0, 2, 1},
                                          {4, 3, 5, 1, 0, 2},
                                          {5, 4, 3, 2, 1, 0}}};

std::array<Tetrahedron, 3> split(const Prism& prism) {
  const auto smallest = static_cast<std::size_t>(std::min_element(prism.begin(), prism.end()) - prism.begin());
  Prism v;
  for (std::size_t i = 0; i < 6; ++i) v[i] = prism[static_cast<std::size_t>(rotations[smallest][i])];
  if (std::min(v[1], v[5]) < std::min(v[2], v[4]))
    return {{{v[0], v[1], v[2], v[5]}, {v[0], v[1], v[5], v[4]}, {v[0], v[4], v[5], v[3]}}};
  return {{{v[0], v[1], v[2], v[4]}, {v[0], v[4], v[2], v[5]}, {v[0], v[4], v[5], v[3]}}};
}

}  // namespace

std::vector<Tetrahedron> split_into_tetrahedra(const std::vector<Prism>& prisms) {
  std::vector<Tetrahedron> tetrahedra;
  tetrahedra.reserve(3 * prisms.size());
  for (const Prism& prism : prisms)
    for (const Tetrahedron& part : split(prism)) tetrahedra.push_back(part);
  return tetrahedra;
}

void use_tetrahedra(WallMesh& wall) {
  if (wall.prisms.empty()) return;
  wall.tetrahedra = split_into_tetrahedra(wall.prisms);
  wall.prisms.clear();
}

}  // namespace tether
