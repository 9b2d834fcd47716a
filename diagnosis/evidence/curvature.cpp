#include "diagnosis/evidence/curvature.hpp"

#include <Eigen/Geometry>
#include <map>

namespace tether {
namespace {

using Edge = std::pair<int, int>;

Vec3 area_of(const Points& points, const Triangle& t) {
  const Vec3 a = points.col(t[0]), b = points.col(t[1]), c = points.col(t[2]);
  return 0.5 * (b - a).cross(c - a);
}

/// Which nodes lie on an edge of one triangle only.
std::vector<bool> rim_of(const LumenSurface& lumen) {
  std::map<Edge, int> count;
  for (const Triangle& t : lumen.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++count[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<bool> rim(static_cast<std::size_t>(lumen.points.cols()), false);
  for (const auto& [edge, triangles] : count)
    if (triangles == 1)
      for (const int node : {edge.first, edge.second}) rim[static_cast<std::size_t>(node)] = true;
  return rim;
}

}  // namespace

VectorXd curvatures(const LumenSurface& lumen) {
  const Eigen::Index n = lumen.points.cols();
  Points gradient = Points::Zero(3, n), normal = Points::Zero(3, n);
  for (const Triangle& t : lumen.triangles) {
    const Vec3 area = area_of(lumen.points, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 opposite = lumen.points.col(t[(k + 2) % 3]) - lumen.points.col(t[(k + 1) % 3]);
      gradient.col(t[k]) += 0.5 * area.normalized().cross(opposite);  // of the triangle's area by this node's place
      normal.col(t[k]) += area;
    }
  }
  const VectorXd areas = nodal_areas(lumen);
  const std::vector<bool> rim = rim_of(lumen);
  VectorXd all = VectorXd::Zero(n), sum = VectorXd::Zero(n), count = VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i)
    if (!rim[static_cast<std::size_t>(i)] && areas(i) > 0)
      all(i) = gradient.col(i).dot(normal.col(i).normalized()) / areas(i);
  for (const Triangle& t : lumen.triangles)
    for (const int i : t)
      for (const int j : t)
        if (rim[static_cast<std::size_t>(i)] && !rim[static_cast<std::size_t>(j)]) sum(i) += all(j), count(i) += 1;
  return (count.array() > 0).select(sum.cwiseQuotient(count.cwiseMax(1)), all);
}

}  // namespace tether
