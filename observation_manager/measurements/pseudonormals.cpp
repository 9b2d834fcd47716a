#include "observation_manager/measurements/pseudonormals.hpp"

#include <algorithm>
#include <numeric>

#include "common/mesh/surface.hpp"

namespace tether {
namespace {

/// An edge of a triangle, from vertex `index` to the next, under its smaller node.
struct Side {
  int high, triangle, index;
};

/// All sides, those of one smaller node together: node i has [start[i], start[i + 1]).
struct Sides {
  std::vector<Side> list;
  std::vector<std::size_t> start;
};

Sides sides_by_node(const std::vector<Triangle>& triangles, std::size_t nodes) {
  Sides sides{std::vector<Side>(3 * triangles.size()), std::vector<std::size_t>(nodes + 1, 0)};
  const auto each = [&](auto visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(triangles[t][i], triangles[t][(i + 1) % 3]);
        visit(static_cast<std::size_t>(low), Side{high, static_cast<int>(t), static_cast<int>(i)});
      }
  };
  each([&](std::size_t low, const Side&) { ++sides.start[low + 1]; });
  std::partial_sum(sides.start.begin(), sides.start.end(), sides.start.begin());
  std::vector<std::size_t> next(sides.start.begin(), sides.start.end() - 1);
  each([&](std::size_t low, const Side& side) { sides.list[next[low]++] = side; });
  return sides;
}

}  // namespace

Pseudonormals::Pseudonormals(const TriangleSurface& surface)
    : triangles(surface.triangles.size()), vertices(nodal_normals(surface.points, surface.triangles)) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    triangles[t].face = area_vector(surface.points, surface.triangles[t]).normalized();

  std::vector<char> on_rim(static_cast<std::size_t>(surface.points.cols()), 0);
  const Sides sides = sides_by_node(surface.triangles, on_rim.size());
  for (std::size_t low = 0; low < on_rim.size(); ++low)
    for (std::size_t s = sides.start[low]; s < sides.start[low + 1]; ++s) {
      const Side& side = sides.list[s];
      TriangleNormals& normals = triangles[static_cast<std::size_t>(side.triangle)];
      Vec3& sum = normals.edge[static_cast<std::size_t>(side.index)] = normals.face;
      bool open = true;
      for (std::size_t other = sides.start[low]; other < sides.start[low + 1]; ++other)
        if (other != s && sides.list[other].high == side.high) {
          sum += triangles[static_cast<std::size_t>(sides.list[other].triangle)].face;
          open = false;
        }
      normals.edge_on_rim[static_cast<std::size_t>(side.index)] = open;
      if (open) on_rim[low] = on_rim[static_cast<std::size_t>(side.high)] = 1;
    }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      triangles[t].vertex_on_rim[i] = on_rim[static_cast<std::size_t>(surface.triangles[t][i])] != 0;
}

}  // namespace tether
