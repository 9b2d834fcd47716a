#include "fsi_master/interface_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"

namespace tether {
namespace {

/// Nodes in cells of a regular grid, so that all within one cell's width of a point are in the 27 cells around it.
class NodeGrid {
 public:
  NodeGrid(const Points& points, double width) : points_(points), width_(width) {
    for (int a = 0; a < points.cols(); ++a) cells_[cell(points.col(a))].push_back(a);
  }

  /// The nearest node closer than the width; -1 if there is none.
  int nearest(const Vec3& x) const {
    int nearest = -1;
    double least = width_;
    const Cell centre = cell(x);
    for (int offset = 0; offset < 27; ++offset) {
      const auto found =
          cells_.find({centre[0] + offset % 3 - 1, centre[1] + offset / 3 % 3 - 1, centre[2] + offset / 9 - 1});
      if (found == cells_.end()) continue;
      for (int a : found->second)
        if (const double distance = (points_.col(a) - x).norm(); distance <= least) nearest = a, least = distance;
    }
    return nearest;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell(const Vec3& x) const {
    return {std::llround(x(0) / width_), std::llround(x(1) / width_), std::llround(x(2) / width_)};
  }
  const Points& points_;
  double width_;
  std::map<Cell, std::vector<int>> cells_;
};

/// Nodes of `from` that have none of `to` within the tolerance, in words; empty if there are none.
std::string lonely(const char* from_name, const Points& from, const char* to_name, const Points& to, double tolerance) {
  const NodeGrid grid(to, tolerance);
  int count = 0, worst = 0;
  double farthest = -1;
  for (int a = 0; a < from.cols(); ++a) {
    if (grid.nearest(from.col(a)) >= 0) continue;
    ++count;
    const double distance = std::sqrt((to.colwise() - from.col(a)).colwise().squaredNorm().minCoeff());
    if (distance > farthest) farthest = distance, worst = a;
  }
  if (count == 0) return {};
  return fmt::format(
      "{} of {} {} nodes have no {} node within {:.2g}, the farthest is {:.4g} away, at ({:.6g}, {:.6g}, {:.6g})",
      count, from.cols(), from_name, to_name, tolerance, farthest, from(0, worst), from(1, worst), from(2, worst));
}

/// The triangles' bounding spheres: a cheap lower bound of a distance.
struct Spheres {
  Points centres;
  Eigen::RowVectorXd radii;

  explicit Spheres(const InterfaceSurface& surface)
      : centres(3, surface.triangles.size()), radii(static_cast<Eigen::Index>(surface.triangles.size())) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const auto [a, b, c] = surface.triangles[t];
      const auto i = static_cast<Eigen::Index>(t);
      centres.col(i) = (surface.points.col(a) + surface.points.col(b) + surface.points.col(c)) / 3;
      radii(i) = 0;
      for (int node : {a, b, c}) radii(i) = std::max(radii(i), (surface.points.col(node) - centres.col(i)).norm());
    }
  }
};

}  // namespace

double diagonal(const Points& points) {
  return points.cols() == 0 ? 0.0 : (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

InterfaceMap InterfaceMap::match(const InterfaceSurface& fluid, const InterfaceSurface& solid, double tolerance) {
  std::string problem = lonely("fluid", fluid.points, "wall", solid.points, tolerance);
  if (problem.empty()) problem = lonely("wall", solid.points, "fluid", fluid.points, tolerance);
  if (!problem.empty()) throw input_error("unmatched interface: {}", problem);
  const NodeGrid grid(solid.points, tolerance);
  InterfaceMap map;
  map.solid_nodes_ = static_cast<int>(solid.points.cols());
  std::vector<int> partner_of(solid.points.cols(), -1);
  for (int a = 0; a < fluid.points.cols(); ++a) {
    const int node = grid.nearest(fluid.points.col(a));
    if (partner_of[node] >= 0)
      throw input_error("unmatched interface: fluid nodes {} and {} are both nearest to wall node {}", partner_of[node],
                        a, node);
    partner_of[node] = a;
    map.means_.push_back({{node, node, node}, {1, 0, 0}});
  }
  return map;
}

InterfaceMap InterfaceMap::nearest_triangle(const InterfaceSurface& fluid, const InterfaceSurface& solid,
                                            double trust) {
  if (solid.triangles.empty())
    throw input_error("the wall announces no interface triangles to map the fluid's nodes to");
  const Spheres spheres(solid);
  InterfaceMap map;
  map.solid_nodes_ = static_cast<int>(solid.points.cols());
  for (int node = 0; node < fluid.points.cols(); ++node) {
    const Vec3 x = fluid.points.col(node);
    const Eigen::RowVectorXd bounds = (spheres.centres.colwise() - x).colwise().norm() - spheres.radii;
    double least = std::numeric_limits<double>::infinity();
    Mean best;
    for (Eigen::Index t = 0; t < bounds.size(); ++t) {
      if (bounds(t) >= least) continue;
      const Triangle& nodes = solid.triangles[static_cast<std::size_t>(t)];
      Mat3 corners;
      for (int i = 0; i < 3; ++i) corners.col(i) = solid.points.col(nodes[i]);
      const Vec3 weights = closest_in_triangle(x, corners.col(0), corners.col(1), corners.col(2));
      const double distance = (corners * weights - x).norm();
      if (distance < least) least = distance, best = {nodes, weights};
    }
    if (least > trust)
      throw input_error(
          "unmatched interface: fluid node {} at ({:.6g}, {:.6g}, {:.6g}) is {:.4g} away from the wall, more than "
          "{:.2g}",
          node, x(0), x(1), x(2), least, trust);
    map.means_.push_back(best);
  }
  return map;
}

std::vector<double> InterfaceMap::to_fluid(const VectorXd& solid) const {
  TETHER_ASSERT(solid.size() == 3 * solid_nodes_, "{} numbers for {} nodes", solid.size(), solid_nodes_);
  std::vector<double> fluid(3 * means_.size());
  for (std::size_t a = 0; a < means_.size(); ++a) {
    const auto& [nodes, weights] = means_[a];
    Vec3 value = Vec3::Zero();
    for (int i = 0; i < 3; ++i) value += weights(i) * solid.segment<3>(3 * nodes[i]);
    std::copy(value.begin(), value.end(), fluid.begin() + static_cast<std::ptrdiff_t>(3 * a));
  }
  return fluid;
}

VectorXd InterfaceMap::to_solid(const std::vector<double>& fluid) const {
  TETHER_ASSERT(fluid.size() == 3 * means_.size(), "{} numbers for {} nodes", fluid.size(), means_.size());
  VectorXd solid = VectorXd::Zero(3 * solid_nodes_);
  for (std::size_t a = 0; a < means_.size(); ++a) {
    const auto& [nodes, weights] = means_[a];
    const Eigen::Map<const Vec3> value(&fluid[3 * a]);
    for (int i = 0; i < 3; ++i) solid.segment<3>(3 * nodes[i]) += weights(i) * value;
  }
  return solid;
}

}  // namespace tether
