// A manufactured solution of the Navier-Stokes equations in the unit box: v = curl of (0, f(x) f(y) h(z) g(t), 0), zero on the
// walls and, with its first normal derivative, on the outlet z = 1; p = 0 there, dp/dn = 0 on the walls.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace {

constexpr double pi = std::numbers::pi, rho = 1.3;

double f(double s) { return std::pow(std::sin(pi * s), 2); }
double df(double s) { return pi * std::sin(2 * pi * s); }
double h(double z) { return 8 * z * z * std::pow(1 - z, 3); }
double dh(double z) { return 8 * (2 * z * std::pow(1 - z, 3) - 3 * z * z * std::pow(1 - z, 2)); }
double g(double t) { return std::cos(3 * t); }

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

struct Outcome {
  Points velocity;
  VectorXd pressure;
  double velocity_error, pressure_error;
};

Outcome run(int cells, double dt, int steps, double mu) {
  FluidSettings chosen = settings(rho, mu);
  chosen.inlets.clear();
  chosen.body_acceleration = [mu](const Vec3& x, double t) { return force(x, t, mu); };
  FluidSolver solver(box_vessel({1, 1, 1}, {cells, cells, cells}, true), chosen);
  start_from(solver, dt, rho, [](const Vec3& x) { return velocity(x, 0); }, [](const Vec3& x) { return pressure(x, 0); });
  run_rigid(solver, dt, steps);
  const double end = dt * steps;
  return {solver.velocity(), solver.pressure(),
          l2_error(solver.domain(), solver.velocity(), [&](const Vec3& x) { return velocity(x, end); }),
          l2_error(solver.domain(), solver.pressure(), [&](const Vec3& x) { return pressure(x, end); })};
}

TEST(Manufactured, SpaceOrder) {
  for (double mu : {0.1, 1e-4}) {
    const Outcome a = run(6, 1.0 / 36, 9, mu), b = run(12, 1.0 / 144, 36, mu);
    printf("mu %g: velocity %g %g order %.2f, pressure %g %g order %.2f\n", mu, a.velocity_error, b.velocity_error,
           order(a.velocity_error, b.velocity_error), a.pressure_error, b.pressure_error, order(a.pressure_error, b.pressure_error));
  }
}

TEST(Manufactured, TimeOrder) {
  const double end = 0.4;
  const Outcome reference = run(8, end / 512, 512, 0.1);
  for (int n : {8, 16, 32, 64, 128}) {
    const Outcome a = run(8, end / n, n, 0.1);
    printf("%d velocity %g pressure %g; exact %g %g\n", n, (a.velocity - reference.velocity).norm(), (a.pressure - reference.pressure).norm(), a.velocity_error, a.pressure_error);
  }
}

}  // namespace
}  // namespace tether::fluid::testing
