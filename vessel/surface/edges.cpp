#include "vessel/surface/edges.hpp"

namespace tether {

EdgeUses edges_of(const std::vector<Triangle>& triangles) {
  EdgeUses edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const int from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      edges[edge_of(from, to)].push_back({static_cast<int>(t), from, to});
    }
  return edges;
}

std::vector<int> patches_of(std::size_t triangles, const EdgeUses& edges) {
  std::vector<int> root(triangles);
  for (std::size_t t = 0; t < triangles; ++t) root[t] = static_cast<int>(t);
  const auto find = [&](int t) {
    while (root[t] != t) t = root[t] = root[root[t]];
    return t;
  };
  for (const auto& [edge, uses] : edges)
    if (uses.size() == 2) root[find(uses[0].triangle)] = find(uses[1].triangle);
  std::map<int, int> number;
  std::vector<int> patch(triangles);
  for (std::size_t t = 0; t < triangles; ++t)
    patch[t] = number.emplace(find(static_cast<int>(t)), static_cast<int>(number.size())).first->second;
  return patch;
}

RawSurface kept(const RawSurface& surface, const std::vector<bool>& keep) {
  RawSurface result;
  std::vector<int> node(static_cast<std::size_t>(surface.points.cols()), -1), old;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!keep[t]) continue;
    Triangle triangle = surface.triangles[t];
    for (int& n : triangle) {
      if (node[n] < 0) node[n] = static_cast<int>(old.size()), old.push_back(n);
      n = node[n];
    }
    result.triangles.push_back(triangle);
    result.face_id.push_back(surface.face_id[t]);
  }
  result.points = points_at(surface.points, old);
  return result;
}

std::vector<std::vector<int>> loops_of(const std::vector<Triangle>& triangles) {
  std::map<int, int> next;
  for (const auto& [edge, uses] : edges_of(triangles))
    if (uses.size() == 1) next[uses[0].from] = uses[0].to;
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int>& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      const int following = at->second;
      loop.push_back(at->first);
      next.erase(at);
      at = next.find(following);
    }
  }
  return loops;
}

Points points_at(const Points& points, const std::vector<int>& nodes) {
  Points result(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = points.col(nodes[i]);
  return result;
}

Vec3 middle(const RawSurface& surface, std::size_t triangle) {
  const Triangle& t = surface.triangles[triangle];
  return (surface.points.col(t[0]) + surface.points.col(t[1]) + surface.points.col(t[2])) / 3;
}

}  // namespace tether
