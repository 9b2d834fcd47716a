#include <cmath>
#include <numbers>

#include "vessel/surface/edges.hpp"
#include "vessel/surface/rims.hpp"

namespace tether {
namespace {

constexpr double same_plane = 0.9998;  // the cosine of one degree
constexpr double sharp = 0.766;        // the cosine of 40 degrees
constexpr double roundness = 0.05;     // area over squared perimeter: 0.080 for a circle, 0.0625 for a square

Vec3 normal_of(const RawSurface& surface, int t) {
  return area_vector(surface.points, surface.triangles[t]).normalized();
}

/// Triangles in the plane of `seed` that hang together with it.
std::vector<int> flat_region(const RawSurface& surface, const EdgeUses& edges, int seed, std::vector<int>& region_of) {
  const Vec3 normal = normal_of(surface, seed);
  std::vector<int> region{seed};
  region_of[seed] = seed;
  for (std::size_t i = 0; i < region.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = surface.triangles[region[i]];
      for (const EdgeUse& use : edges.at(edge_of(t[k], t[(k + 1) % 3])))
        if (region_of[use.triangle] < 0 && normal_of(surface, use.triangle).dot(normal) > same_plane) {
          region_of[use.triangle] = seed;
          region.push_back(use.triangle);
        }
    }
  return region;
}

bool is_end(const RawSurface& surface, const EdgeUses& edges, const std::vector<int>& region,
            const std::vector<int>& of) {
  double perimeter = 0, area = 0, sharp_length = 0;
  for (const int t : region) {
    area += area_vector(surface.points, surface.triangles[t]).norm();
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge = edge_of(surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]);
      for (const EdgeUse& use : edges.at(edge)) {
        if (of[use.triangle] == of[t]) continue;
        const double length = (surface.points.col(edge.first) - surface.points.col(edge.second)).norm();
        perimeter += length;
        if (normal_of(surface, use.triangle).dot(normal_of(surface, t)) < sharp) sharp_length += length;
      }
    }
  }
  // at a slanting end most of the edge is sharp, not all
  return area > roundness * perimeter * perimeter && sharp_length > 0.7 * perimeter;
}

}  // namespace

void open_flat_ends(Repaired& state) {
  const RawSurface& surface = state.surface;
  const EdgeUses edges = edges_of(surface.triangles);
  std::vector<int> region_of(surface.triangles.size(), -1);
  std::vector<bool> keep(surface.triangles.size(), true);
  RepairNote note{RepairKind::caps_found};
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (region_of[t] >= 0) continue;
    const std::vector<int> region = flat_region(surface, edges, static_cast<int>(t), region_of);
    if (region.size() < 4 || !is_end(surface, edges, region, region_of)) continue;
    for (const int one : region) keep[one] = false;
    ++note.count, note.place = middle(surface, t);
  }
  if (note.count == 0) return;
  state.surface = kept(surface, keep);
  state.notes.push_back(note);
}

}  // namespace tether
