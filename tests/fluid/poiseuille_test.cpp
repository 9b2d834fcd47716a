// Steady flow through a rigid tube: u = 2 Q/(pi R^2) (1 - r^2/R^2), dp/dz = - 8 mu Q/(pi R^4), wall shear 4 mu Q/(pi R^3).
#include <gtest/gtest.h>

#include <numbers>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace {

constexpr double pi = std::numbers::pi, R = 1, L = 6, Q = 1, mu = 0.5, rho = 1.0;

/// Away from the inlet, where the projection's dp/dn = 0 leaves a layer of thickness sqrt(nu dt), and from the outlet.
bool in_middle(double z) { return z > L / 3 - 1e-9 && z < 2 * L / 3 + 1e-9; }

struct Errors {
  double velocity, pressure_gradient, shear;  // relative, in the middle third
};

/// Mean pressure of the nodes at height z.
double pressure_at(const FluidSolver& solver, double z) {
  double sum = 0;
  int count = 0;
  for (int node = 0; node < solver.domain().node_count(); ++node)
    if (std::abs(solver.domain().mesh().points(2, node) - z) < 1e-9) sum += solver.pressure()[node], ++count;
  return sum / count;
}

/// Ratio of the axial force on the middle's wall to exact shear stress times area.
double shear_ratio(const FluidSolver& solver, const Points& load) {
  const Surface& sigma = solver.domain().sigma;
  VectorXd area = VectorXd::Zero(load.cols());
  for (std::size_t t = 0; t < sigma.triangles.size(); ++t)
    for (int node : sigma.triangles[t]) area[node] += sigma.area_vectors.col(static_cast<Eigen::Index>(t)).norm() / 3;
  double force = 0, wall = 0;
  for (Eigen::Index a = 0; a < load.cols(); ++a)
    if (in_middle(solver.domain().mesh().points(2, sigma.nodes[static_cast<std::size_t>(a)]))) force += load(2, a), wall += area[a];
  return force / (wall * 4 * mu * Q / (pi * R * R * R));
}

Errors poiseuille(int around) {
  FluidSolver solver(tube(R, L, around, around), settings(rho, mu));
  const Points load = run_rigid(solver, 0.02, 150);
  const auto exact = [](const Vec3& x) -> Vec3 {
    return {0, 0, 2 * Q / (pi * R * R) * (1 - x.head<2>().squaredNorm() / (R * R))};
  };
  Points error = solver.velocity();
  double scale = 0;
  for (int node = 0; node < solver.domain().node_count(); ++node) {
    const Vec3 x = solver.domain().mesh().points.col(node), u = exact(x);
    if (!in_middle(x.z())) error.col(node).setZero();
    else error.col(node) -= u, scale += u.squaredNorm();
  }
  const double gradient = (pressure_at(solver, L / 3) - pressure_at(solver, 2 * L / 3)) / (L / 3);
  return {error.norm() / std::sqrt(scale), std::abs(gradient / (8 * mu * Q / (pi * std::pow(R, 4))) - 1),
          std::abs(shear_ratio(solver, load) - 1)};
}

TEST(Poiseuille, VelocityPressureAndWallShearConverge) {
  const Errors coarse = poiseuille(12), fine = poiseuille(24);
  printf("velocity %g %g order %.2f\npressure %g %g order %.2f\nshear %g %g order %.2f\n", coarse.velocity, fine.velocity,
         order(coarse.velocity, fine.velocity), coarse.pressure_gradient, fine.pressure_gradient, order(coarse.pressure_gradient, fine.pressure_gradient), coarse.shear,
         fine.shear, order(coarse.shear, fine.shear));
}

}  // namespace
}  // namespace tether::fluid::testing
