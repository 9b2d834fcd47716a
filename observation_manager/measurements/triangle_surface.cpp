#include "observation_manager/measurements/triangle_surface.hpp"

#include <algorithm>

namespace tether {

TriangleSurface part_of(const TriangleSurface& surface, const std::vector<bool>& keep) {
  std::vector<int> number(static_cast<std::size_t>(surface.points.cols()), -1), kept;
  TriangleSurface part;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    if (!keep[i]) continue;
    for (int& node : part.triangles.emplace_back(surface.triangles[i])) {
      int& known = number[static_cast<std::size_t>(node)];
      if (known < 0) known = static_cast<int>(kept.size()), kept.push_back(node);
      node = known;
    }
  }
  part.points = surface.points(Eigen::all, kept);
  return part;
}

TriangleSurface part_where(const TriangleSurface& surface, const std::function<bool(const Vec3&)>& kept) {
  std::vector<bool> keep;
  for (const Triangle& t : surface.triangles)
    keep.push_back(std::all_of(t.begin(), t.end(), [&](int node) { return kept(surface.points.col(node)); }));
  return part_of(surface, keep);
}

}  // namespace tether
