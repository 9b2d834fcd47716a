#include "tests/mesh/box.hpp"

#include <algorithm>

#include "common/mesh/topology.hpp"

namespace tether {

namespace {

/// The six orders in which a path from a cube's lowest to its highest corner may take the three axes, even ones first.
constexpr std::array<std::array<int, 3>, 6> axis_orders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

std::vector<Tetrahedron> kuhn_tetrahedra(int corner, const std::array<int, 3>& stride) {
  std::vector<Tetrahedron> six;
  for (std::size_t order = 0; order < 6; ++order) {
    Tetrahedron path{corner, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) path[i + 1] = path[i] + stride[static_cast<std::size_t>(axis_orders[order][i])];
    if (order >= 3) std::swap(path[2], path[3]);
    six.push_back(path);
  }
  return six;
}

}  // namespace

BoxMesh box_mesh(const Vec3& size, const std::array<int, 3>& cells) {
  const std::array<int, 3> stride{1, cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)};
  BoxMesh box;
  box.points.resize(3, stride[2] * (cells[2] + 1));
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        const int node = i + j * stride[1] + k * stride[2];
        box.points.col(node) << size[0] * i / cells[0], size[1] * j / cells[1], size[2] * k / cells[2];
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        for (const Tetrahedron& tetrahedron : kuhn_tetrahedra(node, stride)) box.tetrahedra.push_back(tetrahedron);
      }
  const std::array<const char*, 6> names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  for (std::size_t side = 0; side < 6; ++side) box.sides[side].name = names[side];
  for (const Triangle& face : boundary_triangles(box.tetrahedra))
    for (std::size_t side = 0; side < 6; ++side) {
      const auto axis = static_cast<Eigen::Index>(side / 2);
      const double level = side % 2 == 0 ? 0.0 : size[axis];
      if (std::all_of(face.begin(), face.end(), [&](int node) { return box.points(axis, node) == level; }))
        box.sides[side].triangles.push_back(face);
    }
  return box;
}

}  // namespace tether
