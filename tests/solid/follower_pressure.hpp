#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>

#include "solid/statics.hpp"

namespace tether {

/// A uniform pressure on the interface that follows it, with its tangent (symmetric where rims stay in their planes).
/// `pattern`: the wall's matrix; the mesh must outlive the load.
inline StaticLoad follower_pressure(const WallMesh& wall, double pressure, const SparseMatrix& pattern) {
  const auto scatter = std::make_shared<ScatterMap>(pattern, 3, std::span<const Triangle>(wall.interface));
  return [&wall, pressure, scatter](const Points& x, VectorXd& force, SparseMatrix* tangent) {
    for (std::size_t k = 0; k < wall.interface.size(); ++k) {
      const Triangle& t = wall.interface[k];
      const Vec3 twice_area = (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
      for (int node : t) force.segment<3>(3 * node) += pressure / 6 * twice_area;
      if (tangent == nullptr) continue;
      Eigen::Matrix<double, 9, 9, Eigen::RowMajor> block;
      for (int i = 0; i < 3; ++i) {
        const Vec3 opposite =
            x.col(t[static_cast<std::size_t>((i + 2) % 3)]) - x.col(t[static_cast<std::size_t>((i + 1) % 3)]);
        Mat3 by_corner;  // a -> opposite x a, the change of twice the area
        by_corner << 0, -opposite[2], opposite[1], opposite[2], 0, -opposite[0], -opposite[1], opposite[0], 0;
        for (int a = 0; a < 3; ++a) block.block<3, 3>(3 * a, 3 * i) = -pressure / 6 * by_corner;
      }
      scatter->add(*tangent, k, block.data());
    }
  };
}

/// Positions under a pressure applied in growing steps, halved where Newton does not converge, each started from a
/// straight continuation of the last two. Fails the test if that does not reach it.
inline Points inflate(const WallMesh& wall, const Points& stress_free, const Material& material, double pressure,
                      const std::vector<int>& fixed, double tolerance = 1e-9) {
  const auto elements = make_wall_elements(wall, stress_free);
  Points before = stress_free, x = stress_free;
  double reached = 0, step = pressure / 16, last_step = 0;
  while (reached < pressure && step > 1e-3 * pressure) {
    const double next = std::min(pressure, reached + step);
    const Points start = last_step > 0 ? Points(x + (next - reached) / last_step * (x - before)) : x;
    const StaticLoad load = follower_pressure(wall, next, elements->zero_matrix());
    const StaticResult result = solve_static(*elements, material, start, load, fixed, tolerance, 12);
    if (!result.converged) {
      step /= 2;
      continue;
    }
    before = x;
    x = result.positions;
    last_step = next - reached;
    reached = next;
    step *= 1.5;
  }
  EXPECT_EQ(reached, pressure);
  return x;
}

}  // namespace tether
