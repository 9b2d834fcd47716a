#include "vessel/image/neck.hpp"

#include <algorithm>
#include <queue>

namespace tether {
namespace {

/// Calls `visit(neighbour, distance)` for the voxels about one, corner to corner.
template <class Visit>
void for_neighbours(const ImageVolume& image, std::size_t n, Visit visit) {
  const auto [i, j, k] = image.voxel(n);
  for (int dk = -1; dk <= 1; ++dk)
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di) {
        const int x = i + di, y = j + dj, z = k + dk;
        if ((di == 0 && dj == 0 && dk == 0) || x < 0 || y < 0 || z < 0 || x >= image.count[0] || y >= image.count[1] ||
            z >= image.count[2])
          continue;
        visit(image.at(x, y, z), image.spacing.cwiseProduct(Vec3(di, dj, dk)).norm());
      }
}

/// Distance from what is outside, along steps between neighbours; beyond the image nothing is outside.
std::vector<float> depth_in(const ImageVolume& field) {
  std::vector<float> depth(field.values.size());
  for (std::size_t n = 0; n < depth.size(); ++n) depth[n] = field.values[n] > 0 ? 1e6F : 0;
  const auto lower = [&](std::size_t n) {
    if (depth[n] == 0) return;
    for_neighbours(field, n, [&](std::size_t other, double distance) {
      depth[n] = std::min(depth[n], depth[other] + static_cast<float>(distance));
    });
  };
  for (std::size_t n = 0; n < depth.size(); ++n) lower(n);
  for (std::size_t n = depth.size(); n-- > 0;) lower(n);
  return depth;
}

/// From a place to where the lumen is widest about it.
std::size_t climbed(const ImageVolume& field, const std::vector<float>& depth, std::size_t from) {
  for (std::size_t best = from;; from = best) {
    for_neighbours(field, from, [&](std::size_t other, double) {
      if (depth[other] > depth[best]) best = other;
    });
    if (best == from) return from;
  }
}

/// A voxel on the widest way to it, and where that way is narrowest.
struct Reached {
  float width;
  std::size_t voxel, door;
  bool operator<(const Reached& other) const { return width < other.width; }
};

}  // namespace

Widths widths_of(const ImageVolume& field, const std::vector<std::size_t>& seeds) {
  constexpr float most_ratio = 2, least_voxels = 4;  // a room narrower than that is a blemish of the surface
  const std::vector<float> depth = depth_in(field);
  const auto sphere = [&](std::size_t n) { return InnerSphere{field.place(n), depth[n]}; };
  std::vector<std::size_t> starts;
  for (const std::size_t seed : seeds) starts.push_back(climbed(field, depth, seed));
  if (seeds.empty())
    starts.push_back(static_cast<std::size_t>(std::max_element(depth.begin(), depth.end()) - depth.begin()));

  Widths result;
  std::vector<char> seen(depth.size(), 0);
  std::priority_queue<Reached> border;
  for (const std::size_t start : starts) border.push({depth[start], start, start}), seen[start] = 1;
  float ratio = most_ratio;
  while (!border.empty()) {
    const Reached at = border.top();
    border.pop();
    if (depth[at.voxel] > result.widest.radius) result.widest = sphere(at.voxel);
    if (depth[at.voxel] >= ratio * at.width && depth[at.voxel] > least_voxels * field.spacing.minCoeff()) {
      ratio = depth[at.voxel] / at.width;
      result.neck = {sphere(at.door), sphere(at.voxel)};
    }
    for_neighbours(field, at.voxel, [&](std::size_t other, double) {
      if (depth[other] == 0 || seen[other]) return;
      seen[other] = 1;
      if (depth[other] < at.width)
        border.push({depth[other], other, other});
      else
        border.push({at.width, other, at.door});
    });
  }
  return result;
}

}  // namespace tether
