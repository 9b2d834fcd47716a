#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <numbers>

#include "common/linalg/cholesky.hpp"
#include "solid/statics.hpp"
#include "tests/solid/tube_references.hpp"
#include "tests/solid/walls.hpp"
#include "vessel/sweep.hpp"

/// Slices of tubes in plane strain, their loads and what is measured on them.
namespace tether {

/// Inner radius 2, wall 0.2: the paper's tube.
struct TubeMesh {
  int around = 24, layers = 2;
  ElementKind kind = ElementKind::prism;
  double radius = 2.0, thickness = 0.2;
};

/// Four intervals along, as long as those around.
inline WallMesh tube_slice(const TubeMesh& tube) {
  constexpr int along = 4;
  const double length = along * 2 * std::numbers::pi * tube.radius / tube.around;
  return with_elements(circular_tube(tube.radius, length, tube.thickness, tube.around, along, tube.layers).wall,
                       tube.kind);
}

/// The same with all diagonals of the interface turned the same way round.
inline WallMesh with_one_way_diagonals(WallMesh wall) {
  const auto angle = [&](int node) { return std::atan2(wall.points(1, node), wall.points(0, node)); };
  const auto ahead = [&](int from, int to) {
    return std::remainder(angle(to) - angle(from), 2 * std::numbers::pi) > 1e-9;
  };
  const std::vector<Triangle> old = wall.interface;
  wall.interface.clear();
  for (std::size_t i = 0; i < old.size(); i += 2) {  // the two halves of a quadrilateral follow each other
    std::vector<int> quad = nodes_of({old[i], old[i + 1]});
    std::sort(quad.begin(), quad.end(), [&](int p, int q) { return wall.points(2, p) < wall.points(2, q) - 1e-9; });
    if (ahead(quad[1], quad[0])) std::swap(quad[0], quad[1]);
    if (ahead(quad[3], quad[2])) std::swap(quad[2], quad[3]);
    wall.interface.push_back({quad[0], quad[1], quad[3]});
    wall.interface.push_back({quad[0], quad[3], quad[2]});
  }
  const int layers = static_cast<int>(wall.points.cols()) / wall.interface_nodes - 1;
  wall.prisms.clear();
  for (int layer = 0; layer < layers; ++layer)
    for (const Triangle& t : wall.interface) {
      const int below = layer * wall.interface_nodes, above = below + wall.interface_nodes;
      wall.prisms.push_back({t[0] + below, t[1] + below, t[2] + below, t[0] + above, t[1] + above, t[2] + above});
    }
  return wall;
}

/// Interface node of the slice nearest to a direction across the axis, at the inlet.
inline int node_toward(const WallMesh& wall, const Vec3& direction) {
  int best = 0;
  for (int node = 0; node < wall.interface_nodes; ++node)
    if (direction.dot(wall.points.col(node)) - wall.points(2, node) >
        direction.dot(wall.points.col(best)) - wall.points(2, best))
      best = node;
  return best;
}

/// Unknowns held in plane strain: all axial ones, and three that stop rigid motion across the axis without any
/// reaction.
inline std::vector<int> plane_strain_supports(const WallMesh& wall) {
  std::vector<int> fixed;
  for (int node = 0; node < wall.points.cols(); ++node) fixed.push_back(3 * node + 2);
  fixed.push_back(3 * node_toward(wall, {1, 0, 0}) + 1);
  fixed.push_back(3 * node_toward(wall, {-1, 0, 0}) + 1);
  fixed.push_back(3 * node_toward(wall, {0, 1, 0}));
  return fixed;
}

/// Nodal forces of a pressure p(theta) on the interface, degree 5 (seven points a triangle: Radon 1948). Nodal values
/// of p, interpolated, would lose 2.3 % of cos(2 theta) at 24 nodes around.
inline VectorXd pressure_forces(const WallMesh& wall, const std::function<double(double)>& pressure) {
  const double root = std::sqrt(15.0), inner = (6 - root) / 21, outer = (6 + root) / 21;
  struct Point {
    Vec3 at;
    double weight;
  };
  std::vector<Point> rule{{Vec3::Constant(1.0 / 3), 9.0 / 40}};
  for (const auto& [place, weight] : {std::pair{inner, (155 - root) / 1200}, std::pair{outer, (155 + root) / 1200}})
    for (int i = 0; i < 3; ++i) rule.push_back({Vec3::Constant(place) + (1 - 3 * place) * Vec3::Unit(i), weight});
  VectorXd forces = VectorXd::Zero(wall.points.size());
  for (const Triangle& t : wall.interface) {
    Mat3 corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = wall.points.col(t[static_cast<std::size_t>(i)]);
    const Vec3 area = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)) / 2;
    for (const Point& point : rule) {
      const Vec3 x = corners * point.at;
      const Vec3 force = point.weight * pressure(std::atan2(x[1], x[0])) * area;
      for (int i = 0; i < 3; ++i) forces.segment<3>(3 * t[static_cast<std::size_t>(i)]) += point.at[i] * force;
    }
  }
  return forces;
}

/// Displacement by the tangent at rest.
inline Points linear_response(const WallMesh& wall, const Material& material, const VectorXd& load,
                              const std::vector<int>& fixed) {
  const auto elements = make_wall_elements(wall, wall.points);
  VectorXd force = VectorXd::Zero(load.size()), rhs = load;
  SparseMatrix tangent = elements->zero_matrix();
  elements->static_force(wall.points, material, force, &tangent);
  constrain(tangent, fixed, tangent.coeff(0, 0));
  for (int unknown : fixed) rhs[unknown] = 0;
  Cholesky cholesky;
  cholesky.analyze(tangent, 3);
  cholesky.factor(tangent);
  return cholesky.solve(rhs).reshaped(3, wall.points.cols());
}

/// Fourier coefficient of the interface's outward displacement: mean for n = 0, factor of cos(n theta) otherwise.
inline double radial_mode(const WallMesh& wall, const Points& displacement, int n) {
  double sum = 0;
  for (int node = 0; node < wall.interface_nodes; ++node) {
    const double theta = std::atan2(wall.points(1, node), wall.points(0, node));
    sum += (displacement(0, node) * std::cos(theta) + displacement(1, node) * std::sin(theta)) * std::cos(n * theta);
  }
  return sum / wall.interface_nodes * (n == 0 ? 1 : 2);
}

}  // namespace tether
