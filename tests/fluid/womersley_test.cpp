// Oscillating flow through a rigid tube against Womersley's solution: velocity and pressure gradient.
#include "tests/fluid/womersley.hpp"

#include <gtest/gtest.h>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace womersley_test {

constexpr double pi = std::numbers::pi, omega = 2 * pi, nu = 0.4, rho = 1.06, L = 2;  // Womersley number 4

struct Errors {
  double velocity, gradient;
};

/// A quarter of a period, started from the exact fields.
Errors womersley(int around, int steps) {
  FluidSettings chosen = settings(rho, nu * rho);
  std::vector<double> times, values;
  for (int i = 0; i < 1000; ++i) times.push_back(i / 1000.0), values.push_back(std::cos(2 * pi * i / 1000.0));
  chosen.inlets["inlet"] = {{"flow", {}}, Curve(times, values, {1.0, 0, 1}), 1.0, 0, Profile::womersley};
  FluidSolver solver(tube(1, L, around, around / 4), chosen);
  const double end = 0.25, dt = end / steps;
  const auto exact = [](double t) {
    return [t](const Vec3& x) -> Vec3 {
      return {0, 0, womersley_velocity(omega, nu, std::min(x.head<2>().norm(), 1.0), t)};
    };
  };
  start_from(solver, dt, rho, exact(0),
             [](const Vec3& x) { return womersley_gradient(omega, nu, rho, 0) * (L - x.z()); });
  run_rigid(solver, dt, steps);
  const Points none = Points::Zero(3, solver.domain().node_count());
  const double scale = l2_error(solver.domain(), none, exact(0)),
               gradient_scale = std::abs(womersley_gradient(omega, nu, rho, end));
  return {l2_error(solver.domain(), solver.velocity(), exact(end)) / scale,
          std::abs(observed(solver, "inlet.pressure") / L - womersley_gradient(omega, nu, rho, end)) / gradient_scale};
}

TEST(Womersley, VelocityAndPressureGradientConverge) {
  const Errors coarse = womersley(16, 50), fine = womersley(32, 200);
  report("womersley_velocity", coarse.velocity, fine.velocity);
  report("womersley_pressure_gradient", coarse.gradient, fine.gradient);
  EXPECT_GT(order(coarse.velocity, fine.velocity), 1.5);
  EXPECT_GT(order(coarse.gradient, fine.gradient), 1.5);
  EXPECT_LT(fine.velocity, 0.03);
  EXPECT_LT(fine.gradient, 0.03);
}

}  // namespace womersley_test
}  // namespace tether::fluid::testing
