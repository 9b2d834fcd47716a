#include <gtest/gtest.h>

#include "solid/solid_solver.hpp"
#include "tests/solid/inertia.hpp"
#include "tests/solid/report.hpp"
#include "tests/solid/tube.hpp"

// A swinging beam: energy over many periods, dissipation, orders in time.
namespace tether {
namespace time_stepping_test {

constexpr double young = 1e6, density = 1.0, pi = std::numbers::pi;

/// A short beam bent by a tip force and let go.
struct Swing {
  Swing(double theta, bool conserve_energy, double viscosity = 0, double tip_force = 150)
      : mesh(plate({4, 1, 0.4}, {8, 2}, 1)),
        model(mesh,
              {.material = "neo_hookean",
               .material_values = {young, 0.3},
               .density = density,
               .viscosity = viscosity,
               .theta = theta,
               .conserve_energy = conserve_energy},
              mesh.points, nodes_of(mesh.rings[0].triangles), {}),
        solver(model),
        load(Points::Zero(3, mesh.interface_nodes)) {
    if (tip_force == 0) return;
    VectorXd force = VectorXd::Zero(mesh.points.size());
    const std::vector<int> tip = nodes_of(mesh.rings[1].triangles);
    for (int node : tip) force[3 * node + 2] = tip_force / static_cast<double>(tip.size());
    const StaticLoad pull = [&](const Points&, VectorXd& f, SparseMatrix*) { f += force; };
    const StaticResult bent =
        solve_static(model.elements(), model.material(), mesh.points, pull, model.clamped_unknowns());
    EXPECT_TRUE(bent.converged);
    VectorXd state = solver.state();
    state.head(mesh.points.size()) = (bent.positions - mesh.points).reshaped();
    solver.set_state(state);
  }
  void step(double dt) {
    solver.begin_step(time, dt);
    solver.evaluate(load);
    solver.accept();
    time += dt;
  }
  double energy() const {
    const VectorXd u = solver.velocity().reshaped();
    const double kinetic = u.dot(inertia(model.elements(), mesh.points, {&model.material(), 0, density}, u)) / 2;
    return kinetic + model.elements().energy(mesh.points + solver.displacement(), model.material());
  }
  double tip() const { return solver.displacement()(2, 8); }

  WallMesh mesh;
  WallModel model;
  SolidSolver solver;
  Points load;
  double time = 0;
};

constexpr double period = 0.2505;  // of the swing, roughly: Euler and Bernoulli say 0.248

constexpr int periods = 20, steps_a_period = 40;

struct Trace {
  double worst = 0;  ///< largest relative change of the energy
  int turns = 0;     ///< times the tip went down through zero
};

/// Twenty periods of a free swing.
Trace trace_energy(bool conserve_energy, const std::string& name) {
  Swing swing(0.5, conserve_energy);
  const double start = swing.energy();
  EXPECT_GT(swing.tip(), 0.2) << "a finite rotation";
  Trace trace;
  std::vector<double> time, energy;
  for (int step = 0; step < periods * steps_a_period; ++step) {
    const double before = swing.tip();
    swing.step(period / steps_a_period);
    trace.turns += before > 0 && swing.tip() <= 0;
    time.push_back(swing.time / period);
    energy.push_back(swing.energy() / start - 1);
    trace.worst = std::max(trace.worst, std::abs(energy.back()));
  }
  report(name, trace.worst);
  write_series(name, time, energy);
  return trace;
}

TEST(FreeVibration, EnergyIsConservedOverManyPeriods) {
  const Trace trace = trace_energy(true, "energy_conserving");
  EXPECT_GE(trace.turns, periods - 1);
  EXPECT_LE(trace.worst, 1e-9);
}

TEST(FreeVibration, TheMidpointRuleKeepsItsEnergyBounded) {
  const Trace trace = trace_energy(false, "energy_midpoint");
  EXPECT_GE(trace.turns, periods - 1);
  EXPECT_LE(trace.worst, 0.01);
  EXPECT_GT(trace.worst, 1e-6) << "it is not the conserving rule";
}

TEST(FreeVibration, ThetaAboveOneHalfDamps) {
  Swing swing(0.55, false);
  double last = swing.energy();
  for (int step = 0; step < 80; ++step) {
    swing.step(period / 40);
    EXPECT_LT(swing.energy(), last);
    last = swing.energy();
  }
}

/// Tip after a push that rises smoothly from nothing, so that only slow modes move, in so many steps.
double tip_after(int steps, double theta, bool conserve_energy) {
  Swing swing(theta, conserve_energy, 0, 0);
  const double end = 0.6 * period, dt = end / steps;
  const std::vector<int> tip = nodes_of(swing.mesh.rings[1].triangles);
  for (int step = 0; step < steps; ++step) {
    const double rise = std::pow(std::sin(pi / 2 * (step + theta) / steps), 4);
    for (int node : tip)
      if (node < swing.mesh.interface_nodes) swing.load(2, node) = 100 * rise;
    swing.step(dt);
  }
  return swing.tip();
}

/// Differences between runs of 40, 80, 160 and 320 steps.
void expect_second_order_in_time(bool conserve_energy, const std::string& name) {
  std::array<double, 4> tip;
  for (std::size_t i = 0; i < 4; ++i) tip[i] = tip_after(40 << i, 0.5, conserve_energy);
  const std::array change{tip[0] - tip[1], tip[1] - tip[2], tip[2] - tip[3]};
  report(name, std::array{40, 80, 160}, change);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(change[i] / change[i + 1]), 2, 0.05);
}

TEST(TimeOrder, IsTwoAtTheMidpoint) {
  expect_second_order_in_time(false, "time_midpoint");
  expect_second_order_in_time(true, "time_energy_conserving");
}

/// What theta = 0.55 changes is of first order; below some hundred steps a period it hides behind the second.
TEST(TimeOrder, IsOneBeyondTheMidpoint) {
  std::array<double, 3> change;
  for (int i = 0; i < 3; ++i) change[std::size_t(i)] = tip_after(40 << i, 0.55, false) - tip_after(40 << i, 0.5, false);
  report("time_theta_0.55", std::array{40, 80, 160}, change);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(change[i] / change[i + 1]), 1, 0.05);
}

/// With the conserving rule, what the energy loses in a step is what the viscous force takes: dt V . f_visc >= 0.
TEST(FreeVibration, ViscosityDissipatesExactlyItsPower) {
  Swing swing(0.5, true, 2000);
  for (int step = 0; step < 40; ++step) {
    const double before = swing.energy(), dt = period / 40;
    const Points start = swing.mesh.points + swing.solver.displacement();
    swing.step(dt);
    const Points v = (swing.mesh.points + swing.solver.displacement() - start) / dt, none = Points::Zero(3, v.cols());
    const auto force = [&](double viscosity) {
      VectorXd f = VectorXd::Zero(v.size());
      swing.model.elements().step_force({start, v, none, 0.5, dt, true}, {&swing.model.material(), viscosity, density},
                                        f, nullptr);
      return f;
    };
    const double taken = dt * (force(2000) - force(0)).dot(v.reshaped());
    EXPECT_GE(taken, 0);
    EXPECT_NEAR(before - swing.energy(), taken, 1e-9 * before);
  }
}

}  // namespace time_stepping_test
}  // namespace tether
