// The mesh motion and what it must not disturb: a uniform flow, the balance of mass.
#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "tests/fluid/fluid_testing.hpp"

namespace tether::fluid::testing {
namespace moving_mesh_test {

constexpr double pi = std::numbers::pi;

/// A tube whose wall breathes and sways, rims included: displacement of the interface at a time.
Points motion(const FluidDomain& domain, double t) {
  Points result = domain.sigma.local(domain.mesh().points);
  for (auto x : result.colwise()) {
    const double grow = 0.1 * std::sin(3 * t) * (1 + 0.5 * std::sin(2 * x.z()));
    x = Vec3(grow * x.x() + 0.05 * std::sin(t), grow * x.y(), 0.05 * std::sin(2 * t) * (1 + x.x()));
  }
  return result;
}

TEST(Jacobians, AFoldedMeshNamesItsWorstElement) {
  FluidSolver solver(tube(1, 2, 12, 6), settings(1, 0.04));
  Points crush = zero_on_sigma(solver);
  crush.row(0) = -2 * solver.domain().sigma.local(solver.domain().mesh().points).row(0);
  const VectorXd before = solver.state();
  try {
    solver.begin_step(0, 0.1, crush);
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("element"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("reference volume"), std::string::npos) << error.what();
  }
  EXPECT_EQ(solver.state(), before);
  run_rigid(solver, 0.1, 1);  // it goes on
}

TEST(Extension, KeepsRigidMotionsAndTheBoundary) {
  const FluidMesh mesh = tube(1, 2, 12, 6);
  for (auto kind : {MeshMotionKind::harmonic, MeshMotionKind::elastic}) {
    const FluidDomain domain(mesh, kind);
    const Points shift = Vec3(0.3, -0.1, 0.2).replicate(1, static_cast<Eigen::Index>(domain.sigma.nodes.size()));
    EXPECT_LT((domain.extend(shift) - Vec3(0.3, -0.1, 0.2).replicate(1, domain.node_count())).norm(), 1e-11);
    const Points moved = motion(domain, 1);
    EXPECT_LT((domain.sigma.local(domain.extend(moved)) - moved).norm(), 1e-14);
  }
}

/// Geometric conservation: v = U everywhere stays, however the mesh moves, inside and at its boundary.
TEST(UniformFlow, SurvivesAnyMeshMotion) {
  FluidDomain domain(box_vessel({1, 1, 1}, {4, 4, 4}), MeshMotionKind::harmonic);
  const Vec3 U(0.7, -1.1, 0.4);
  std::vector<int> fixed = domain.sigma.nodes;
  const std::vector<const Surface*> open{&domain.inlets[0], &domain.outlets[0]};
  AdvectionDiffusion stage(domain, fixed);
  Projection projection(domain, {domain.inlets[0].nodes, domain.outlets[0].nodes});
  const auto rheology =
      find_effect(rheologies(), "carreau_yasuda").make(std::vector<double>{0.04, 0.5, 1.9, 0.2, 1.25});

  const double dt = 0.01, rho = 1.06,
               no_backflow = 0;  // it would hold up what enters through the inlet, left open here
  const Points everywhere = U.replicate(1, domain.node_count()), force;
  const Points carried = Points::Zero(3, static_cast<Eigen::Index>(domain.tetrahedra().size()));
  Points displacement = Points::Zero(3, domain.node_count());
  for (unsigned n = 0; n < 3; ++n) {
    const Points next = random_points(domain.node_count(), 0.03, n), w = (next - displacement) / dt;
    displacement = next;
    domain.place(displacement);
    Points velocity = everywhere + random_points(domain.node_count(), 0.5, 10 + n);  // a bad guess
    velocity(Eigen::all, fixed) = everywhere(Eigen::all, fixed);
    const auto result =
        stage.solve(domain, {rho, dt, no_backflow, *rheology, everywhere, carried, w, force, open}, 1e-14, velocity);
    EXPECT_TRUE(result.converged);
    EXPECT_LT((velocity - everywhere).cwiseAbs().maxCoeff(), 1e-12);

    // The projection then finds no pressure: the flow is solenoidal on the moved mesh.
    projection.factor(domain, dt / rho, std::vector<double>{0, 0});
    VectorXd rhs = VectorXd::Zero(domain.node_count());
    for (std::size_t e = 0; e < domain.tetrahedra().size(); ++e)
      for (std::size_t a = 0; a < 4; ++a)
        rhs[domain.tetrahedra()[e][a]] +=
            domain.geometry()[e].volume * U.dot(domain.geometry()[e].grad_N.col(static_cast<int>(a)));
    rhs(domain.sigma.nodes) -= domain.sigma.flux(domain.sigma.local(everywhere));
    const auto solution = projection.solve(rhs, VectorXd::Zero(2));
    EXPECT_LT(solution.pressure.cwiseAbs().maxCoeff(), 1e-11 * rho / dt);
    EXPECT_NEAR(solution.flow[0], open[0]->total_flux(open[0]->local(everywhere)), 1e-13);
    EXPECT_NEAR(solution.flow[1], open[1]->total_flux(open[1]->local(everywhere)), 1e-13);
  }
}

/// inflow - outflow - interface flux in one step, and against the true change of volume: the largest over half a
/// second.
std::pair<double, double> balance_errors(double dt) {
  FluidSettings chosen = settings(1.06, 0.04);
  chosen.inlets["inlet"].curve = Curve({0, 0.5}, {0, 3});
  chosen.outlets["outlet"].effect = {"windkessel",
                                     {{"proximal_resistance", 20}, {"distal_resistance", 200}, {"compliance", 1e-3}}};
  FluidSolver solver(tube(1, 2, 12, 6), chosen);
  Points y0 = zero_on_sigma(solver), y_before = y0;
  double mass = 0, volume = 0;
  for (int n = 0; n < std::lround(0.5 / dt); ++n) {
    const Points y1 = motion(solver.domain(), (n + 1) * dt), predicted = 2 * y0 - y_before;
    solver.begin_step(n * dt, dt, predicted);
    solver.evaluate(y1, (y1 - y0) / dt);
    solver.accept();
    y_before = y0;
    y0 = y1;
    mass = std::max(mass, std::abs(observed(solver, "mass_balance_error")));
    if (n > 2) volume = std::max(volume, std::abs(observed(solver, "volume_balance_error")));
  }
  EXPECT_NEAR(observed(solver, "volume"), solver.domain().volume(y0), 1e-13);
  return {mass, volume};
}

TEST(MassBalance, IsKeptToRoundOffAndOfTheTrueVolumeToFirstOrder) {
  const auto [mass_coarse, volume_coarse] = balance_errors(0.01);
  const auto [mass_fine, volume_fine] = balance_errors(0.005);
  EXPECT_LT(mass_coarse, 1e-10);
  EXPECT_LT(mass_fine, 1e-10);
  report("volume_balance", volume_coarse, volume_fine);
  EXPECT_NEAR(order(volume_coarse, volume_fine), 1, 0.15);
}

/// Relative difference of the pressures at the wall between a tube at rest and one that glides along itself and aside,
/// both with a flow through the inlet as it moves, when the flow has settled.
double pressure_seen_from_a_gliding_tube(int around, int along) {
  const Vec3 glide(0.4, 0, 0.8);
  const double dt = 0.01;
  FluidSettings through_ring = settings(1, 0.5);
  through_ring.inlets["inlet"].through_ring = true;
  FluidSolver resting(tube(1, 2, around, along), settings(1, 0.5)), gliding(tube(1, 2, around, along), through_ring);
  start_from(
      gliding, dt, 1, [&](const Vec3&) { return glide; }, [](const Vec3&) { return 0.0; });
  Points rest, moved;
  const Points everywhere = glide.replicate(1, zero_on_sigma(resting).cols());
  for (int n = 0; n < 60; ++n) {
    rest = step(resting, n * dt, dt, zero_on_sigma(resting), zero_on_sigma(resting));
    moved = step(gliding, n * dt, dt, (n + 1) * dt * everywhere, everywhere);
  }
  EXPECT_NEAR(observed(gliding, "inlet.flow"), 1, 1e-12) << "through the face as it moves";
  EXPECT_NEAR(observed(gliding, "mass_balance_error"), 0, 1e-11);
  EXPECT_NEAR(observed(gliding, "volume_balance_error"), 0, 1e-9);
  return (moved - rest).norm() / rest.norm();
}

/// What is given is the flow through the moving face: a glide of blood and wall together changes nothing, but that
/// Temam's term (F.4) sees it where the discrete flow is not solenoidal. (The glide carries 2.5 times the flow through
/// a face that stays.)
TEST(MovingInlet, AGlidingTubeHasThePressureOfOneAtRest) {
  const double coarse = pressure_seen_from_a_gliding_tube(10, 5), fine = pressure_seen_from_a_gliding_tube(20, 10);
  report("gliding", coarse, fine);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse);
}

}  // namespace moving_mesh_test
}  // namespace tether::fluid::testing
