// Steady flow of a power-law fluid through a tube: u ~ 1 - r^((n + 1)/n), - dp/dz = 2 K ((3 n + 1)/n Q/(pi R^3))^n / R.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace rheology_flow_test {

constexpr double pi = std::numbers::pi, n = 0.6, K = 1, rho = 1, L = 4, dt = 0.005;

double gradient(double flow) {
  return 2 * K * std::pow((3 * n + 1) / n * flow / pi, n);
}

double speed(double r, double flow) {
  return (3 * n + 1) / (n + 1) * flow / pi * (1 - std::pow(std::min(r, 1.0), (n + 1) / n));
}

/// What v~ carries of the flow 1, see poiseuille_test.cpp: Q = Q~ + dt/rho |grad p| pi R^2.
double carried_flow() {
  double flow = 1;
  for (int i = 0; i < 100; ++i) flow = 1 - dt / rho * gradient(flow) * pi;
  return flow;
}

struct Errors {
  double velocity, gradient;  // relative, away from the inlet, whose profile is that of a Newtonian fluid
};

Errors power_law(int around) {
  FluidSettings chosen = settings(rho, K);
  chosen.rheology = {"power_law", {{"viscosity", K}, {"index", n}, {"lowest_shear_rate", 1e-3}}};
  FluidSolver solver(tube(1, L, around, around / 2), chosen);
  const double flow = carried_flow();
  start_from(
      solver, dt, rho,
      [&](const Vec3& x) -> Vec3 {
        return {0, 0, speed(x.head<2>().norm(), flow)};
      },
      [&](const Vec3& x) { return gradient(flow) * (L - x.z()); });
  run_rigid(solver, dt, 100);
  double error = 0, scale = 0, middle = 0, three_quarters = 0;
  int count = 0;
  for (int node = 0; node < solver.domain().node_count(); ++node) {
    const Vec3 x = solver.domain().mesh().points.col(node);
    if (std::abs(x.z() - L / 2) < 1e-9) middle += solver.pressure()[node], ++count;
    if (std::abs(x.z() - 3 * L / 4) < 1e-9) three_quarters += solver.pressure()[node];
    if (std::abs(x.z() - 3 * L / 4) > 1e-9) continue;
    error += std::pow(solver.velocity()(2, node) - speed(x.head<2>().norm(), flow), 2);
    scale += std::pow(speed(x.head<2>().norm(), flow), 2);
  }
  const double found = (middle - three_quarters) / count / (L / 4);
  return {std::sqrt(error / scale), std::abs(found / gradient(flow) - 1)};
}

TEST(PowerLaw, TubeFlowConverges) {
  const Errors coarse = power_law(16), fine = power_law(32);
  report("power_law_velocity", coarse.velocity, fine.velocity);
  report("power_law_pressure_gradient", coarse.gradient, fine.gradient);
  EXPECT_GT(order(coarse.velocity, fine.velocity), 1.2);
  EXPECT_GT(order(coarse.gradient, fine.gradient), 1.2);
  EXPECT_LT(fine.velocity, 0.025);
  EXPECT_LT(fine.gradient, 0.02);
}

/// The viscosity's gradient must not disturb a developed flow at the outlet: there mu dv/dn = 0, not the whole
/// traction.
TEST(PowerLaw, LeavesTheOutletUndisturbed) {
  FluidSettings chosen = settings(rho, K);
  chosen.rheology = {"power_law", {{"viscosity", K}, {"index", n}, {"lowest_shear_rate", 1e-3}}};
  FluidSolver solver(tube(1, L, 16, 8), chosen);
  start_from(
      solver, dt, rho,
      [&](const Vec3& x) -> Vec3 {
        return {0, 0, speed(x.head<2>().norm(), 1)};
      },
      [&](const Vec3& x) { return gradient(1) * (L - x.z()); });
  run_rigid(solver, dt, 100);
  const EndFace& outlet = solver.domain().outlets[0];
  const Points v = outlet.local(solver.velocity());
  EXPECT_LT(v.topRows<2>().norm(), 0.02 * v.row(2).norm());
}

}  // namespace rheology_flow_test
}  // namespace tether::fluid::testing
