#include "fsi_master/transfer/interface_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "common/base/error.hpp"

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
std::string lonely(const char* from_name, const Points& from, const char* to_name, const Points& to, double tolerance,
                   const UnitSystem& units) {
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
      "{} of {} {} nodes have no {} node within {:.2g} mm, the farthest is {:.4g} mm away, at ({:.6g}, {:.6g}, {:.6g}) "
      "{}",
      count, from.cols(), from_name, to_name, units.to_mm(tolerance), units.to_mm(farthest), from(0, worst),
      from(1, worst), from(2, worst), units.symbol(dimension::length));
}

/// Of each fluid node the wall's, for nodes without a mismatch. Throws InputError if two have the same.
std::vector<int> wall_nodes(const Points& fluid, const Points& solid, double tolerance) {
  const NodeGrid grid(solid, tolerance);
  std::vector<int> nodes, fluid_of(static_cast<std::size_t>(solid.cols()), -1);
  for (int a = 0; a < fluid.cols(); ++a) {
    nodes.push_back(grid.nearest(fluid.col(a)));
    int& taken = fluid_of[static_cast<std::size_t>(nodes.back())];
    if (taken >= 0)
      throw input_error("unmatched interface: fluid nodes {} and {} are both nearest to wall node {}", taken, a,
                        nodes.back());
    taken = a;
  }
  return nodes;
}

/// Whichever way they are written.
std::set<Triangle> sorted(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  return {triangles.begin(), triangles.end()};
}

/// What is wrong with a matching of the nodes; empty if nothing is.
std::string mismatch(const Points& fluid, const Points& solid, double tolerance, const UnitSystem& units) {
  std::string problem = lonely("fluid", fluid, "wall", solid, tolerance, units);
  return problem.empty() ? lonely("wall", solid, "fluid", fluid, tolerance, units) : problem;
}

}  // namespace

InterfaceMap::InterfaceMap(Points fluid, Points solid, const Rows& rows, std::vector<int> solved, const Mass& mass)
    : fluid_(std::move(fluid)), solid_(std::move(solid)), rows_(rows), solved_(std::move(solved)) {
  if (solved_.empty()) return;
  mass_ = std::make_unique<Eigen::SparseLU<Mass>>(mass);
  if (mass_->info() != Eigen::Success)
    throw input_error("the interfaces cannot be joined by mortar ({}): use coupling.mapping: nearest_triangle",
                      mass_->lastErrorMessage());
}

bool InterfaceMap::matches(const InterfaceSurface& fluid, const InterfaceSurface& solid, double tolerance) {
  if (fluid.points.cols() != solid.points.cols() ||
      !mismatch(fluid.points, solid.points, tolerance, UnitSystem::cgs()).empty())
    return false;
  if (fluid.triangles.empty() || solid.triangles.empty()) return true;
  const std::vector<int> nodes = wall_nodes(fluid.points, solid.points, tolerance);
  std::vector<Triangle> triangles = fluid.triangles;
  for (Triangle& triangle : triangles)
    for (auto& node : triangle) node = nodes[static_cast<std::size_t>(node)];
  return sorted(triangles) == sorted(solid.triangles);
}

InterfaceMap InterfaceMap::match(const InterfaceSurface& fluid, const InterfaceSurface& solid, double tolerance,
                                 const UnitSystem& units) {
  const std::string problem = mismatch(fluid.points, solid.points, tolerance, units);
  if (!problem.empty()) throw input_error("unmatched interface: {}", problem);
  const std::vector<int> nodes = wall_nodes(fluid.points, solid.points, tolerance);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < fluid.points.size(); ++i)
    entries.emplace_back(i, 3 * nodes[static_cast<std::size_t>(i / 3)] + i % 3, 1.0);
  Rows rows(fluid.points.size(), solid.points.size());
  rows.setFromTriplets(entries.begin(), entries.end());
  InterfaceMap map(fluid.points, solid.points, rows, {}, {});
  map.node_for_node_ = true;
  return map;
}

std::vector<double> InterfaceMap::to_fluid(const VectorXd& solid) const {
  TETHER_ASSERT(solid.size() == rows_.cols(), "{} numbers for {} nodes", solid.size(), solid_nodes());
  std::vector<double> values(static_cast<std::size_t>(rows_.rows()));
  Eigen::Map<VectorXd> fluid(values.data(), rows_.rows());
  fluid = rows_ * solid;
  solve_mass(fluid, false);
  return values;
}

VectorXd InterfaceMap::to_solid(const std::vector<double>& fluid) const {
  TETHER_ASSERT(static_cast<Eigen::Index>(fluid.size()) == rows_.rows(), "{} numbers for {} nodes", fluid.size(),
                fluid_nodes());
  VectorXd load = Eigen::Map<const VectorXd>(fluid.data(), rows_.rows());
  solve_mass(load, true);
  return rows_.transpose() * load;
}

InterfaceBalance InterfaceMap::balance(const AtFluid& fluid, const AtSolid& solid) const {
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  };
  return tether::balance({fluid_, vector(fluid.load), vector(fluid.motion)}, {solid_, solid.forces, solid.motion});
}

void InterfaceMap::solve_mass(Eigen::Ref<VectorXd> fluid, bool transposed) const {
  if (solved_.empty()) return;
  MatrixXd values(solved_.size(), 3);
  for (std::size_t i = 0; i < solved_.size(); ++i)
    values.row(static_cast<Eigen::Index>(i)) = fluid.segment<3>(3 * solved_[i]).transpose();
  if (transposed)
    values = mass_->transpose().solve(values).eval();
  else
    values = mass_->solve(values).eval();
  for (std::size_t i = 0; i < solved_.size(); ++i)
    fluid.segment<3>(3 * solved_[i]) = values.row(static_cast<Eigen::Index>(i)).transpose();
}

}  // namespace tether
