// A tube that slides to and fro along its axis drags the blood in it: v_z = W Re(J0(k r)/J0(k) e^(i omega t)), k^2 = -
// i omega/nu, p = 0: an exact solution of the Navier-Stokes equations (Stokes' second problem in a tube of radius 1).
#include <gtest/gtest.h>

#include "tests/fluid/fluid_testing.hpp"
#include "tests/fluid/womersley.hpp"

namespace tether::fluid::testing {
namespace sliding_wall_test {

constexpr double pi = std::numbers::pi, omega = 2 * pi, nu = 0.7, rho = 1.06, L = 0.75, W = 3;  // Womersley number 3

const std::complex<double> k = std::sqrt(std::complex<double>(0, -omega / nu));

double velocity(double r, double t) {
  return W * (bessel_j(0, k * r) / bessel_j(0, k) * std::polar(1.0, omega * t)).real();
}

/// Axial traction of the blood on the wall, - mu dv_z/dr at r = 1.
double shear(double t) {
  return rho * nu * W * (k * bessel_j(1, k) / bessel_j(0, k) * std::polar(1.0, omega * t)).real();
}

struct Errors {
  double velocity, shear, pressure;  // at the end; the pressure over the largest shear
  double sideways;                   // force across the axis over the axial one
};

/// 3/8 of a period, in which the wall slides by 0.34 of its radius at most, and turns back. The mesh goes with it.
Errors sliding_tube(int around, int steps) {
  FluidSettings chosen = settings(rho, nu * rho);
  chosen.inlets["inlet"] = {{"pressure", {}}, Curve::constant(0)};
  chosen.blood.values["backflow_stabilisation"] = 0;  // blood crosses both ends, which move with the wall
  FluidSolver solver(tube(1, L, around, around / 8), chosen);
  const double end = 0.375, dt = end / steps;
  start_from(
      solver, dt, rho,
      [](const Vec3& x) -> Vec3 {
        return {0, 0, velocity(std::min(x.head<2>().norm(), 1.0), 0)};
      },
      [](const Vec3&) { return 0.0; });
  const auto slid = [&](double t) -> Points {
    return Vec3(0, 0, W / omega * std::sin(omega * t)).replicate(1, zero_on_sigma(solver).cols());
  };
  Points load;
  for (int n = 0; n < steps; ++n)
    load = step(solver, n * dt, dt, slid((n + 1) * dt), (slid((n + 1) * dt) - slid(n * dt)) / dt);
  const Vec3 force = load.rowwise().sum();
  const auto exact = [&](const Vec3& x) -> Vec3 { return {0, 0, velocity(std::min(x.head<2>().norm(), 1.0), end)}; };
  const Points none = Points::Zero(3, solver.domain().node_count());
  return {l2_error(solver.domain(), solver.velocity(), exact) / l2_error(solver.domain(), none, exact),
          std::abs(force.z() / (2 * pi * L * shear(end)) - 1),
          solver.pressure().cwiseAbs().maxCoeff() / std::abs(shear(end)), force.head<2>().norm() / std::abs(force.z())};
}

TEST(SlidingWall, DragsTheBloodAndFeelsItsShear) {
  const Errors coarse = sliding_tube(24, 120), fine = sliding_tube(48, 480);
  report("sliding_wall_velocity", coarse.velocity, fine.velocity);
  report("sliding_wall_shear", coarse.shear, fine.shear);
  EXPECT_NEAR(order(coarse.velocity, fine.velocity), 2, 0.3);
  EXPECT_NEAR(order(coarse.shear, fine.shear), 1, 0.15);
  EXPECT_LT(fine.velocity, 0.015);
  EXPECT_LT(fine.shear, 0.04);
  EXPECT_LT(fine.pressure, coarse.pressure);
  EXPECT_LT(fine.pressure, 0.01);
  for (const Errors& errors : {coarse, fine}) EXPECT_LT(errors.sideways, 1e-4);
}

}  // namespace sliding_wall_test
}  // namespace tether::fluid::testing
