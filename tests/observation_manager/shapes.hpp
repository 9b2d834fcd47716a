#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "observation_manager/measurements/signed_surface.hpp"

/// Triangulated shapes whose distances are known, triangles counterclockwise seen from outside.
namespace tether::testing {

/// x(i, j) of a grid of `rows` by `columns` quadrilaterals, each cut in two; closed in either direction on request.
/// With rows going around right-handed, columns along, triangles look outward.
struct Grid {
  int rows, columns;
  bool rows_close = false, columns_close = false;
};
inline TriangleSurface grid(const Grid& g, const std::function<Vec3(int row, int column)>& x) {
  const int rows = g.rows + (g.rows_close ? 0 : 1), columns = g.columns + (g.columns_close ? 0 : 1);
  const auto node = [&](int i, int j) { return (i % rows) * columns + j % columns; };
  TriangleSurface surface;
  surface.points.resize(3, rows * columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) surface.points.col(node(i, j)) = x(i, j);
  for (int i = 0; i < g.rows; ++i)
    for (int j = 0; j < g.columns; ++j) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  return surface;
}

/// An open tube about the z axis, from z = 0 to `length`, whose nodes lie on radius(z).
inline TriangleSurface tube(int around, int along, double length, const std::function<double(double)>& radius) {
  return grid({around, along, true, false}, [&](int i, int j) {
    const double angle = 2 * std::numbers::pi * i / around, z = length * j / along, r = radius(z);
    return Vec3(r * std::cos(angle), r * std::sin(angle), z);
  });
}

inline TriangleSurface torus(double large, double small, int around, int across) {
  return grid({around, across, true, true}, [&](int i, int j) {
    const double u = 2 * std::numbers::pi * i / around, v = -2 * std::numbers::pi * j / across;
    const double r = large + small * std::cos(v);
    return Vec3(r * std::cos(u), r * std::sin(u), -small * std::sin(v));
  });
}

/// The cube |x|, |y|, |z| <= 1, its faces cut into n by n squares, with common nodes on the edges.
TriangleSurface cube(int n);

/// A unit sphere: the cube's nodes moved onto it.
inline TriangleSurface sphere(int n) {
  TriangleSurface surface = cube(n);
  // The angle, not the tangent, is divided equally: triangles of similar size.
  surface.points = (surface.points.array() * (std::numbers::pi / 4)).tan().matrix();
  surface.points.colwise().normalize();
  return surface;
}

}  // namespace tether::testing
