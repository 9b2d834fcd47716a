#pragma once

#include "common/mesh/mesh.hpp"
#include "common/mesh/topology.hpp"
#include "tests/solid/differences.hpp"

/// Small walls for tests.
namespace tether {

enum class ElementKind { prism, tetrahedron };

inline const char* name_of(ElementKind kind) {
  return kind == ElementKind::prism ? "prism" : "tetrahedron";
}

/// The same wall cut into tetrahedra, if these are asked for.
inline WallMesh with_elements(WallMesh wall, ElementKind kind) {
  if (kind == ElementKind::prism) return wall;
  wall.tetrahedra = split_into_tetrahedra(wall.prisms);
  wall.prisms.clear();
  return wall;
}

/// Where the diagonals of a grid of quadrilaterals run.
enum class Diagonals { one_way, alternating };

/// A flat plate: cells[0] x cells[1] quadrilaterals cut in two, `layers` of prisms, thickness along z; the interface is
/// its lower side. Node (i, j, k) is i + (nx + 1) (j + (ny + 1) k). Patches: outside "top", rings "x_min" and "x_max".
inline WallMesh plate(const Vec3& size, const std::array<int, 2>& cells, int layers,
                      Diagonals diagonals = Diagonals::alternating) {
  const int nx = cells[0] + 1, ny = cells[1] + 1, level = nx * ny;
  WallMesh wall;
  wall.points.resize(3, level * (layers + 1));
  for (int k = 0; k <= layers; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        wall.points.col(i + nx * (j + ny * k)) << size[0] * i / cells[0], size[1] * j / cells[1], size[2] * k / layers;
  wall.interface_nodes = level;
  for (int j = 0; j < cells[1]; ++j)
    for (int i = 0; i < cells[0]; ++i) {
      const int a = i + nx * j, b = a + 1, c = b + nx, d = a + nx;
      const bool rising = diagonals == Diagonals::one_way || (i + j) % 2 == 0;
      wall.interface.push_back(rising ? Triangle{a, b, c} : Triangle{a, b, d});
      wall.interface.push_back(rising ? Triangle{a, c, d} : Triangle{b, c, d});
    }
  wall.outside.push_back({"top", {}});
  wall.rings = {{"x_min", {}}, {"x_max", {}}};
  for (int k = 0; k < layers; ++k)
    for (const Triangle& t : wall.interface) {
      const int below = k * level, above = below + level;
      wall.prisms.push_back({t[0] + below, t[1] + below, t[2] + below, t[0] + above, t[1] + above, t[2] + above});
    }
  for (const Triangle& t : wall.interface) {
    const int above = layers * level;
    wall.outside[0].triangles.push_back({t[0] + above, t[1] + above, t[2] + above});
  }
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < cells[1]; ++j) {
      const int a = nx * (j + ny * k), b = a + nx;
      for (const Triangle& t : split_quadrilateral(a, a + level, b + level, b)) wall.rings[0].triangles.push_back(t);
      const int c = a + cells[0], d = b + cells[0];
      for (const Triangle& t : split_quadrilateral(c, d, d + level, c + level)) wall.rings[1].triangles.push_back(t);
    }
  return wall;
}

/// A plate of irregular triangles: inner nodes moved in the plane, the same way in all layers; layers of unequal
/// thickness; edges through the thickness oblique. Every prism has parallel faces and parallel edges.
inline WallMesh irregular_plate(unsigned seed) {
  const std::array<int, 2> cells{4, 3};
  WallMesh wall = plate({4, 3, 1}, cells, 3);
  Random random(seed);
  for (int j = 1; j < cells[1]; ++j)
    for (int i = 1; i < cells[0]; ++i) {
      const Vec3 shift(0.25 * random(), 0.25 * random(), 0);
      for (int node = i + (cells[0] + 1) * j; node < wall.points.cols(); node += wall.interface_nodes)
        wall.points.col(node) += shift;
    }
  for (Eigen::Index node = 0; node < wall.points.cols(); ++node) {
    double& z = wall.points(2, node);
    z = 0.7 * z + 0.3 * z * z;
    wall.points(0, node) += 0.4 * z;
  }
  return wall;
}

/// The irregular plate bent over two axes and every node moved a little: no prism has a constant Jacobian.
inline WallMesh crumpled_plate(unsigned seed) {
  WallMesh wall = irregular_plate(seed);
  Random random(seed + 1);
  for (Eigen::Index node = 0; node < wall.points.cols(); ++node) {
    Vec3 x = wall.points.col(node);
    x[2] += 0.08 * x[0] * x[0] - 0.05 * x[0] * x[1];
    wall.points.col(node) = x + 0.05 * Vec3(random.matrix(3, 1));
  }
  return wall;
}

}  // namespace tether
