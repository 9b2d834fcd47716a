// Steady flow through a rigid tube: u = 2 Q/(pi R^2) (1 - r^2/R^2), dp/dz = - 8 mu Q/(pi R^4), wall shear 4 mu Q/(pi
// R^3).
#include <gtest/gtest.h>

#include <numbers>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace poiseuille_test {

constexpr double pi = std::numbers::pi, R = 1, L = 3, Q = 1, mu = 0.5, rho = 1.0;

/// Away from the inlet, where the projection's dp/dn = 0 leaves a layer of thickness sqrt(nu dt), and from the outlet.
bool in_middle(double z) {
  return z > L / 3 - 1e-9 && z < 2 * L / 3 + 1e-9;
}

struct Errors {
  double velocity, pressure_gradient, shear;  // relative, in the middle third
  double observed_shear;                      // of the whole wall
};

/// Mean pressure of the nodes at height z.
double pressure_at(const FluidSolver& solver, double z) {
  double sum = 0;
  int count = 0;
  for (int node = 0; node < solver.domain().node_count(); ++node)
    if (std::abs(solver.domain().mesh().points(2, node) - z) < 1e-9) sum += solver.pressure()[node], ++count;
  return sum / count;
}

/// Ratio of the axial force on the middle's wall to its area.
double wall_shear(const FluidSolver& solver, const Points& load) {
  const Surface& sigma = solver.domain().sigma;
  VectorXd area = VectorXd::Zero(load.cols());
  for (std::size_t t = 0; t < sigma.triangles.size(); ++t)
    for (int node : sigma.triangles[t]) area[node] += sigma.area_vectors.col(static_cast<Eigen::Index>(t)).norm() / 3;
  double force = 0, wall = 0;
  for (Eigen::Index a = 0; a < load.cols(); ++a)
    if (in_middle(solver.domain().mesh().points(2, sigma.nodes[static_cast<std::size_t>(a)])))
      force += load(2, a), wall += area[a];
  return force / wall;
}

/// Relative error of the velocity at the middle's nodes.
double velocity_error(const FluidSolver& solver, double flow) {
  double error = 0, scale = 0;
  for (int node = 0; node < solver.domain().node_count(); ++node) {
    const Vec3 x = solver.domain().mesh().points.col(node);
    if (!in_middle(x.z())) continue;
    const Vec3 exact(0, 0, 2 * flow / (pi * R * R) * (1 - x.head<2>().squaredNorm() / (R * R)));
    error += (solver.velocity().col(node) - exact).squaredNorm();
    scale += exact.squaredNorm();
  }
  return std::sqrt(error / scale);
}

/// What v~ carries of Q in the steady state: v = v~ - dt/rho grad p slips along the wall, and Q is the flux of v. With
/// grad p = - 8 mu Q~/(pi R^4) it follows that Q = Q~ (1 + 8 nu dt/R^2).
double carried_flow(double dt) {
  return Q / (1 + 8 * mu / rho * dt / (R * R));
}

Errors poiseuille(int around) {
  constexpr double dt = 0.04;
  FluidSolver solver(tube(R, L, around, 3 * around / 8), settings(rho, mu));
  const Points load = run_rigid(solver, dt, 80);
  const double flow = carried_flow(dt);
  const double gradient = (pressure_at(solver, L / 3) - pressure_at(solver, 2 * L / 3)) / (L / 3);
  return {velocity_error(solver, flow), std::abs(gradient / (8 * mu * flow / (pi * std::pow(R, 4))) - 1),
          std::abs(wall_shear(solver, load) / (4 * mu * flow / (pi * R * R * R)) - 1),
          std::abs(observed(solver, "wall_shear") / (4 * mu * flow / (pi * R * R * R)) - 1)};
}

TEST(Poiseuille, VelocityPressureAndWallShearConverge) {
  const Errors coarse = poiseuille(24), fine = poiseuille(48);
  report("poiseuille_velocity", coarse.velocity, fine.velocity);
  report("poiseuille_pressure_gradient", coarse.pressure_gradient, fine.pressure_gradient);
  report("poiseuille_wall_shear", coarse.shear, fine.shear);
  report("poiseuille_mean_wall_shear", coarse.observed_shear, fine.observed_shear);
  EXPECT_GT(order(coarse.velocity, fine.velocity), 1.5);
  EXPECT_GT(order(coarse.pressure_gradient, fine.pressure_gradient), 1.5);
  EXPECT_LT(fine.velocity, 0.025);
  EXPECT_LT(fine.pressure_gradient, 0.025);
  EXPECT_LT(fine.shear, coarse.shear);  // manufactured_test.cpp has its order
  EXPECT_LT(fine.shear, 0.025);
  EXPECT_LT(fine.observed_shear, 0.025);  // with the layers at both ends, which are those of dt
}

}  // namespace poiseuille_test
}  // namespace tether::fluid::testing
