// A manufactured solution of the Navier-Stokes equations in the unit box: v = curl of (0, f(x) f(y) h(z) g(t), 0), zero
// on the walls and, with its first normal derivative, on the outlet z = 1; p = 0 there, dp/dn = 0 on the walls.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace manufactured_test {

constexpr double pi = std::numbers::pi, rho = 1.3;

double f(double s) {
  return std::pow(std::sin(pi * s), 2);
}
double df(double s) {
  return pi * std::sin(2 * pi * s);
}
double h(double z) {
  return 8 * z * z * std::pow(1 - z, 3);
}
double dh(double z) {
  return 8 * (2 * z * std::pow(1 - z, 3) - 3 * z * z * std::pow(1 - z, 2));
}
double g(double t) {
  return std::cos(3 * t);
}

Vec3 velocity(const Vec3& x, double t) {
  return g(t) * Vec3(-f(x[0]) * f(x[1]) * dh(x[2]), 0, df(x[0]) * f(x[1]) * h(x[2]));
}
double pressure(const Vec3& x, double t) {
  return 2 * g(t) * std::cos(pi * x[0]) * std::cos(pi * x[1]) * std::cos(pi * x[2] / 2);
}

/// dv/dt + v.grad v - nu laplace v + grad p / rho, by central differences of the exact fields.
Vec3 force(const Vec3& x, double t, double mu) {
  constexpr double e = 1e-4;
  Vec3 result = (velocity(x, t + e) - velocity(x, t - e)) / (2 * e);
  const Vec3 v = velocity(x, t);
  for (int j = 0; j < 3; ++j) {
    const Vec3 d = e * Vec3::Unit(j), right = velocity(x + d, t), left = velocity(x - d, t);
    result += v[j] * (right - left) / (2 * e) - mu / rho * (right - 2 * v + left) / (e * e);
    result[j] += (pressure(x + d, t) - pressure(x - d, t)) / (2 * e * rho);
  }
  return result;
}

/// Relative error of the viscous traction - mu dv_z/dn on the wall x = 0, as root of the mean square over its inner
/// nodes.
double shear_error(const FluidSolver& solver, const Points& load, double t, double mu) {
  const Surface& sigma = solver.domain().sigma;
  const Points x = sigma.local(solver.domain().mesh().points);
  const VectorXd area = sigma.pressure_force(VectorXd::Ones(load.cols())).row(0).cwiseAbs();
  double error = 0, scale = 0;
  for (Eigen::Index a = 0; a < load.cols(); ++a) {
    if (x(0, a) > 0 || x.col(a).tail<2>().minCoeff() == 0 || x.col(a).tail<2>().maxCoeff() == 1) continue;
    const double exact = mu * g(t) * 2 * pi * pi * f(x(1, a)) * h(x(2, a));
    error += std::pow(load(2, a) / area[a] - exact, 2);
    scale += exact * exact;
  }
  return std::sqrt(error / scale);
}

struct Outcome {
  Points velocity;
  VectorXd pressure;
  double velocity_error, pressure_error, shear_error;
};

Outcome run(int cells, double dt, int steps, double mu) {
  FluidSettings chosen = settings(rho, mu);
  chosen.inlets.clear();
  chosen.body_acceleration = [mu](const Vec3& x, double t) { return force(x, t, mu); };
  FluidSolver solver(box_vessel({1, 1, 1}, {cells, cells, cells}, true), chosen);
  start_from(
      solver, dt, rho, [](const Vec3& x) { return velocity(x, 0); }, [](const Vec3& x) { return pressure(x, 0); });
  const Points load = run_rigid(solver, dt, steps);
  const double end = dt * steps;
  return {solver.velocity(), solver.pressure(),
          l2_error(solver.domain(), solver.velocity(), [&](const Vec3& x) { return velocity(x, end); }),
          l2_error(solver.domain(), solver.pressure(), [&](const Vec3& x) { return pressure(x, end); }),
          shear_error(solver, load, end, mu)};
}

class Manufactured : public ::testing::TestWithParam<double> {};

/// dt ~ h^2, so that the first order in time does not show. Cell Reynolds numbers up to 1 and 1000: the latter stands
/// on SUPG.
TEST_P(Manufactured, IsOfSecondOrderInSpace) {
  const Outcome coarse = run(8, 1.0 / 64, 16, GetParam()), fine = run(16, 1.0 / 256, 64, GetParam());
  report(fmt::format("manufactured_space_{}", GetParam()), coarse.velocity_error, fine.velocity_error);
  report(fmt::format("manufactured_space_pressure_{}", GetParam()), coarse.pressure_error, fine.pressure_error);
  EXPECT_NEAR(order(coarse.velocity_error, fine.velocity_error), 2, 0.25);
  EXPECT_NEAR(order(coarse.pressure_error, fine.pressure_error), 2, 0.25);
  EXPECT_LT(fine.velocity_error, 0.02);
  if (GetParam() < 0.1) return;  // there the mesh resolves the wall's layer
  report("manufactured_shear", coarse.shear_error, fine.shear_error);
  EXPECT_GT(order(coarse.shear_error, fine.shear_error), 0.9);
}
INSTANTIATE_TEST_SUITE_P(Viscosities, Manufactured, ::testing::Values(0.1, 1e-4));

/// Differences of runs with dt, dt/2 and dt/4 on one mesh: the splitting is of first order, its pressure of at least
/// one half.
TEST(ManufacturedInTime, IsOfFirstOrder) {
  const double end = 0.4, mu = 0.1;
  const Outcome a = run(12, end / 32, 32, mu), b = run(12, end / 64, 64, mu), c = run(12, end / 128, 128, mu);
  const double velocity_coarse = (a.velocity - b.velocity).norm(), velocity_fine = (b.velocity - c.velocity).norm();
  const double pressure_coarse = (a.pressure - b.pressure).norm(), pressure_fine = (b.pressure - c.pressure).norm();
  report("manufactured_time", velocity_coarse, velocity_fine);
  report("manufactured_time_pressure", pressure_coarse, pressure_fine);
  EXPECT_NEAR(order(velocity_coarse, velocity_fine), 1, 0.15);
  EXPECT_GT(order(pressure_coarse, pressure_fine), 0.5);
}

}  // namespace manufactured_test
}  // namespace tether::fluid::testing
