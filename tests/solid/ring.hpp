#pragma once

#include <cmath>
#include <numbers>

#include "common/mesh/mesh.hpp"

namespace tether::testing {

/// A straight wall, structured: `around` x `along` cells in `layers`, prisms from quadrilaterals cut along alternating
/// or equal diagonals.
struct TubeShape {
  double inner_radius = 2, thickness = 0.2, length = 1;
  int around = 24, along = 2, layers = 2;
};

inline int tube_node(const TubeShape& s, int i, int k, int layer) {
  return layer * s.around * (s.along + 1) + k * s.around + (i % s.around);
}

inline WallMesh structured_tube(const TubeShape& s) {
  WallMesh mesh;
  mesh.points.resize(3, s.around * (s.along + 1) * (s.layers + 1));
  for (int layer = 0; layer <= s.layers; ++layer)
    for (int k = 0; k <= s.along; ++k)
      for (int i = 0; i < s.around; ++i) {
        const double angle = 2 * std::numbers::pi * i / s.around, r = s.inner_radius + s.thickness * layer / s.layers;
        mesh.points.col(tube_node(s, i, k, layer)) << r * std::cos(angle), r * std::sin(angle), s.length * k / s.along;
      }
  for (int k = 0; k < s.along; ++k)
    for (int i = 0; i < s.around; ++i) {
      const std::array<std::array<int, 2>, 4> corner{{{i, k}, {i + 1, k}, {i + 1, k + 1}, {i, k + 1}}};
      const std::array<std::array<int, 3>, 2> cut = (i + k) % 2 == 0
                                                        ? std::array<std::array<int, 3>, 2>{{{0, 1, 2}, {0, 2, 3}}}
                                                        : std::array<std::array<int, 3>, 2>{{{0, 1, 3}, {1, 2, 3}}};
      for (const auto& t : cut) {
        const auto node = [&](int c, int layer) {
          return tube_node(s, corner[static_cast<std::size_t>(t[static_cast<std::size_t>(c)])][0],
                           corner[static_cast<std::size_t>(t[static_cast<std::size_t>(c)])][1], layer);
        };
        mesh.interface.push_back({node(0, 0), node(1, 0), node(2, 0)});
        for (int layer = 0; layer < s.layers; ++layer)
          mesh.prisms.push_back({node(0, layer), node(1, layer), node(2, layer), node(0, layer + 1), node(1, layer + 1),
                                 node(2, layer + 1)});
      }
    }
  mesh.interface_nodes = s.around * (s.along + 1);
  return mesh;
}

/// Nodal forces of a pressure p(angle) on the reference interface, integrated with 7 points a triangle (degree 5).
template <class Pressure>
VectorXd pressure_forces(const WallMesh& mesh, const Points& x, const Pressure& pressure) {
  constexpr double a = 0.059715871789770, b = 0.470142064105115, c = 0.797426985353087, d = 0.101286507323456;
  constexpr std::array<std::array<double, 4>, 7> points{{{1.0 / 3, 1.0 / 3, 1.0 / 3, 0.225},
                                                         {a, b, b, 0.132394152788506},
                                                         {b, a, b, 0.132394152788506},
                                                         {b, b, a, 0.132394152788506},
                                                         {c, d, d, 0.125939180544827},
                                                         {d, c, d, 0.125939180544827},
                                                         {d, d, c, 0.125939180544827}}};
  VectorXd force = VectorXd::Zero(3 * x.cols());
  for (const Triangle& t : mesh.interface) {
    const Vec3 area = 0.5 * (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
    for (const auto& q : points) {
      const Vec3 at = q[0] * mesh.points.col(t[0]) + q[1] * mesh.points.col(t[1]) + q[2] * mesh.points.col(t[2]);
      const double p = pressure(std::atan2(at[1], at[0]));
      for (std::size_t node = 0; node < 3; ++node) force.segment<3>(3 * t[node]) += q[3] * q[node] * p * area;
    }
  }
  return force;
}

/// Every node's axial displacement: plane strain.
inline std::vector<int> axial_unknowns(const WallMesh& mesh) {
  std::vector<int> fixed;
  for (int node = 0; node < mesh.points.cols(); ++node) fixed.push_back(3 * node + 2);
  return fixed;
}

}  // namespace tether::testing
