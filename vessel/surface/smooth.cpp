#include "vessel/surface/smooth.hpp"

#include "vessel/surface/edges.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace {

/// Moves each node by `factor` toward the mean of its neighbours.
void step(Points& points, const EdgeUses& edges, const std::vector<bool>& fixed, double factor) {
  Points sum = Points::Zero(3, points.cols());
  VectorXd count = VectorXd::Zero(points.cols());
  for (const auto& [edge, uses] : edges) {
    sum.col(edge.first) += points.col(edge.second);
    sum.col(edge.second) += points.col(edge.first);
    ++count[edge.first], ++count[edge.second];
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!fixed[i] && count[i] > 0) points.col(i) += factor * (sum.col(i) / count[i] - points.col(i));
}

}  // namespace

double smooth(RawSurface& surface, int pairs) {
  const double before = enclosed_volume(surface);
  const EdgeUses edges = edges_of(surface.triangles);
  std::vector<bool> fixed(static_cast<std::size_t>(surface.points.cols()), false);
  for (const auto& [edge, uses] : edges)
    if (uses.size() == 1) fixed[edge.first] = fixed[edge.second] = true;
  // A pass band of 0.04 (1 / shrink + 1 / swell, Taubin 1995): with 0.1 a tube of 32 nodes round swells by 0.8 % in 20
  // pairs.
  constexpr double shrink = 0.5, swell = -0.51;
  for (int i = 0; i < pairs; ++i) {
    step(surface.points, edges, fixed, shrink);
    step(surface.points, edges, fixed, swell);
  }
  return enclosed_volume(surface) / before - 1;
}

}  // namespace tether
