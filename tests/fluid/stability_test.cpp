// Where a plain Galerkin method, or an untreated outlet, would fail.
#include <gtest/gtest.h>

#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace {

/// Steady advection through a box toward a wall where the value is held at one: a layer thinner than an element. The
/// blood rests; the mesh runs against it (w = -a), which makes the stage a linear advection-diffusion problem with
/// velocity a.
double overshoot(double peclet) {
  const int n = 10;
  FluidDomain domain(box_vessel({1, 1, 1}, {2, 2, n}), MeshMotionKind::harmonic);
  std::vector<int> fixed = domain.inlets[0].nodes;
  fixed.insert(fixed.end(), domain.outlets[0].nodes.begin(), domain.outlets[0].nodes.end());
  AdvectionDiffusion stage(domain, fixed);
  const double speed = 1, rho = 1, mu = rho * speed / n / (2 * peclet), dt = 10;
  const auto rheology = find_effect(rheologies(), "newtonian").make(std::vector<double>{mu});
  const Points w = Vec3(0, 0, -speed).replicate(1, domain.node_count()), force;
  const Points carried = Points::Zero(3, static_cast<Eigen::Index>(domain.tetrahedra().size()));
  const std::vector<const Surface*> open;
  Points v = Points::Zero(3, domain.node_count());
  constexpr double tiny = 1e-9;  // so small that it does not advect itself
  for (int node : domain.outlets[0].nodes) v(0, node) = tiny;
  for (int i = 0; i < 20; ++i) {
    const Points v0 = v;
    EXPECT_TRUE(stage.solve(domain, {rho, dt, 0, *rheology, v0, carried, w, force, open}, 1e-12, v).converged);
  }
  return std::max(v.row(0).maxCoeff() / tiny - 1, -v.row(0).minCoeff() / tiny);
}

TEST(Supg, KeepsLayersAtHighPecletNumbersFromOscillating) {
  for (double peclet : {2.0, 20.0, 2000.0}) EXPECT_LT(overshoot(peclet), 0.05) << peclet;
}

/// Blood drawn back in through the outlet, fast and nearly inviscid: mean of the nodes' squared speeds after a while.
double kinetic_energy(double beta) {
  FluidSettings chosen = settings(1.06, 0.004);
  chosen.blood.values["backflow_stabilisation"] = beta;
  chosen.inlets["inlet"].curve = Curve({0, 0.2}, {0, -600});
  FluidSolver solver(tube(1, 2, 16, 6), chosen);
  try {
    run_rigid(solver, 0.002, 400);
  } catch (const std::exception&) {
    return infinite;
  }
  return solver.velocity().squaredNorm() / static_cast<double>(solver.velocity().cols());
}

TEST(Backflow, StaysBounded) {
  const double plug = std::pow(600 / std::numbers::pi, 2);  // speed squared of the same flow as a plug
  const double none = kinetic_energy(0), standard = kinetic_energy(0.2), full = kinetic_energy(0.5);
  EXPECT_LT(standard, plug);
  EXPECT_LT(full, standard);
  EXPECT_LT(standard, none);
}

}  // namespace
}  // namespace tether::fluid::testing
