#include <gtest/gtest.h>

#include "solid/solid_solver.hpp"
#include "solid/supports/registry.hpp"
#include "tests/solid/tube.hpp"
#include "tests/solid/walls.hpp"

// The solver: its equations and tangent, its two ways through a step, and states that continue bit for bit.
namespace tether {
namespace {

Configured<Support> spring(double stiffness, double damping) {
  return {supports(), {"visco_elastic", {{"stiffness", stiffness}, {"damping", damping}}}};
}

/// A short tube, clamped at the inlet, on a spring at the outlet and in tissue outside, with viscosity; with a
/// neighbour its stiffness depends on the time, since that comes and goes.
struct Vessel {
  explicit Vessel(bool conserve_energy = false, bool has_neighbour = false)
      : wall(circular_tube(2, 2, 0.2, 8, 3).wall),
        model(wall, settings(conserve_energy), wall.points, nodes_of(wall.rings[0].triangles), held(has_neighbour)),
        solver(model) {}

  static WallSettings settings(bool conserve_energy) {
    return {.material = "neo_hookean",
            .material_values = {4e6, 0.45},
            .density = 1.2,
            .viscosity = 500,
            .conserve_energy = conserve_energy,
            .support_on_current_area = true};
  }
  std::vector<SurfaceSupport> held(bool has_neighbour) const {
    std::vector<SurfaceSupport> list;
    if (has_neighbour)
      list.emplace_back(
          wall.outside[0],
          Configured<Support>{supports(), {"contact", {{"stiffness", 1e6}, {"gap", 0.0}, {"smoothing", 0.05}}}},
          [](double t) { return AffineDisplacement{Vec3(0.05 * std::sin(100 * t), 0, 0)}; });
    list.emplace_back(wall.outside[0], spring(1e5, 1e3));
    list.emplace_back(wall.rings[1], spring(1e6, 0),
                      [](double t) { return AffineDisplacement{Vec3(0, 0, 0.05 * std::sin(20 * t))}; });
    return list;
  }
  /// A pressure that rises, with a part that bends the tube.
  Points load(double time) const {
    const VectorXd forces =
        pressure_forces(wall, [&](double theta) { return 1e6 * time * (1 + 0.3 * std::cos(theta)); });
    return forces.reshaped(3, wall.points.cols()).leftCols(wall.interface_nodes);
  }
  void step(double dt) {
    solver.begin_step(time, dt);
    solver.evaluate(load(time + dt));
    solver.accept();
    time += dt;
  }
  void steps(int count, double dt = 2e-3) {
    for (int i = 0; i < count; ++i) step(dt);
  }

  WallMesh wall;
  WallModel model;
  SolidSolver solver;
  double time = 0;
};

double relative(const Points& a, const Points& b) {
  return (a - b).norm() / b.norm();
}

TEST(SolidSolver, OpenFormAndEvaluationEndAtTheSameMotion) {
  for (const bool conserving : {false, true}) {
    Vessel closed(conserving), open(conserving);
    closed.steps(3), open.steps(3);
    const Points load = closed.load(0.02);
    closed.solver.begin_step(closed.time, 2e-3);
    open.solver.begin_step(open.time, 2e-3);
    const InterfaceMotion expected = closed.solver.evaluate(load);
    VectorXd correction, first;
    int corrections = 0;
    for (int iteration = 0; iteration < 10; ++iteration) {
      const VectorXd residual = open.solver.residual(correction, load);
      if (iteration == 0) first = residual;
      if (residual.norm() <= 1e-11 * first.norm()) break;
      correction = VectorXd::Zero(residual.size());
      ++corrections;
      EXPECT_TRUE(conjugate_gradients([&](const VectorXd& v) { return open.solver.product(v); },
                                      [&](const VectorXd& r) { return open.solver.precondition(r); }, residual,
                                      correction, 1e-8, 100)
                      .converged);
    }
    EXPECT_GT(corrections, 1);
    EXPECT_LE(relative(open.solver.interface_motion().velocity, expected.velocity), 1e-8);
    EXPECT_LE(relative(open.solver.interface_motion().displacement, expected.displacement), 1e-9);
  }
}

TEST(SolidSolver, ProductIsSymmetricAndPositiveAndKeepsClampedNodesStill) {
  Vessel vessel;
  vessel.steps(2);
  vessel.solver.begin_step(vessel.time, 2e-3);
  vessel.solver.residual({}, vessel.load(0.01));
  Random random(4);
  const VectorXd v = random.matrix(vessel.model.unknowns(), 1), w = random.matrix(vessel.model.unknowns(), 1);
  const VectorXd kv = vessel.solver.product(v), kw = vessel.solver.product(w);
  EXPECT_NEAR(w.dot(kv), v.dot(kw), 1e-12 * kv.norm() * w.norm());
  EXPECT_GT(v.dot(kv), 0);
  const VectorXd z = vessel.solver.precondition(v);
  for (int unknown : vessel.model.clamped_unknowns()) EXPECT_EQ(z[unknown], 0);
}

/// A strip pressed together by a twentieth, which it does not bear: in so long a step its mass does not hold it, and
/// the tangent is indefinite. What preconditions is not, or the run would end there.
TEST(SolidSolver, AWallThatBucklesHasAPreconditionerThatIsPositiveDefinite) {
  const WallMesh strip = plate({10, 1, 0.1}, {40, 4}, 1);
  std::vector<int> ends = nodes_of(strip.rings[0].triangles);
  const std::vector<int> other = nodes_of(strip.rings[1].triangles);
  ends.insert(ends.end(), other.begin(), other.end());
  WallModel model(strip, {.material = "neo_hookean", .material_values = {1e6, 0.45}, .density = 1}, strip.points, ends,
                  {});
  SolidSolver solver(model);
  Points pressed = Points::Zero(3, strip.points.cols());
  pressed.row(0) = -0.05 * strip.points.row(0);
  solver.displace(pressed);
  solver.begin_step(0, 1e-2);
  solver.residual({}, Points::Zero(3, strip.interface_nodes));

  const double k = 0.6 * std::numbers::pi;  // its sine is zero at both ends
  Points waves = Points::Zero(3, strip.points.cols());
  for (Eigen::Index node = 0; node < waves.cols(); ++node) {
    const Vec3 x = strip.points.col(node);
    waves.col(node) << -(x[2] - 0.05) * k * std::cos(k * x[0]), 0, std::sin(k * x[0]);
  }
  for (const int unknown : model.clamped_unknowns()) waves.reshaped()[unknown] = 0;
  const VectorXd bent = waves.reshaped();
  EXPECT_LT(bent.dot(solver.product(bent)), 0);
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    const VectorXd v = random.matrix(model.unknowns(), 1);
    EXPECT_GT(v.dot(solver.precondition(v)), 0);
  }
}

/// Of the residual at a given iterate: the product is its derivative (viscosity leaves out a part of the size of the
/// strain).
TEST(SolidSolver, ProductIsTheDerivativeOfTheResidual) {
  Vessel vessel;
  vessel.model.parameters().set("solid.viscosity", 0);
  vessel.steps(3);
  const Points load = vessel.load(0.01);
  Random random(5);
  VectorXd direction = random.matrix(vessel.model.unknowns(), 1);
  for (int unknown : vessel.model.clamped_unknowns()) direction[unknown] = 0;
  const auto residual_at = [&](double t) {
    vessel.solver.rewind();
    vessel.solver.begin_step(vessel.time, 2e-3);
    return vessel.solver.residual(t * direction, load);
  };
  const VectorXd slope = derivative(residual_at, 1e-2);
  residual_at(0);
  EXPECT_LE((vessel.solver.product(direction) + slope).norm(), 1e-7 * slope.norm());
}

TEST(SolidSolver, TangentIsTheDifferenceOfEvaluations) {
  Vessel vessel;
  vessel.model.parameters().set("solid.viscosity", 0);
  vessel.steps(3);
  const Points load = vessel.load(0.01), change = vessel.load(0.01) - 2 * vessel.load(0.02);
  const auto motion_at = [&](double t) {
    vessel.solver.begin_step(vessel.time, 2e-3);
    return vessel.solver.evaluate(load + t * change);
  };
  const Points by_difference = (motion_at(1e-4).velocity - motion_at(-1e-4).velocity) / 2e-4;
  motion_at(0);
  const InterfaceMotion tangent = vessel.solver.tangent(change);
  EXPECT_LE(relative(tangent.velocity, by_difference), 1e-6);
  EXPECT_LE(relative(tangent.displacement, 2e-3 * tangent.velocity), 1e-15);
}

TEST(SolidSolver, ARewoundStepIsForgotten) {
  Vessel straight, rewound;
  straight.steps(3), rewound.steps(3);
  for (const double dt : {2e-3, 2e-3}) {
    rewound.solver.begin_step(rewound.time, dt);
    rewound.solver.evaluate(10 * rewound.load(0.05));
    rewound.solver.rewind();
  }
  straight.steps(3), rewound.steps(3);
  EXPECT_EQ(straight.solver.displacement(), rewound.solver.displacement());
  EXPECT_EQ(straight.solver.velocity(), rewound.solver.velocity());
}

/// Steps of changing length, so that the factor is made anew at other displacements, and a parameter changed on the
/// way.
void run_on(Vessel& vessel) {
  vessel.steps(2, 2e-3);
  vessel.steps(2, 1e-3);
  vessel.model.parameters().set("solid.material.young", 5e6);
  vessel.steps(3, 1e-3);
}

/// The same from a state, with what a state does not hold: parameters and time are the master's.
void put(Vessel& vessel, const VectorXd& state, double time, double young) {
  vessel.model.parameters().set("solid.material.young", young);
  vessel.solver.set_state(state);
  vessel.time = time;
}

class AFreshSolver : public ::testing::TestWithParam<bool> {};

TEST_P(AFreshSolver, ContinuesBitForBit) {
  Vessel original(false, GetParam());
  original.steps(3, 1e-3);
  original.steps(3, 2e-3);
  original.model.parameters().set("solid.material.young", 3e6);
  original.steps(2);
  const VectorXd state = original.solver.state();
  const double time = original.time;
  EXPECT_EQ(state.size(), original.solver.state_size());
  run_on(original);

  Vessel fresh(false, GetParam());
  put(fresh, state, time, 3e6);
  EXPECT_EQ(fresh.solver.state(), state) << "state packed and unpacked";
  run_on(fresh);
  EXPECT_EQ(fresh.solver.state(), original.solver.state());
}

INSTANTIATE_TEST_SUITE_P(, AFreshSolver, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "WithANeighbourThatMoves" : "ByItself"; });

TEST(SolidSolver, TheSameSolverContinuesBitForBitFromAnEarlierState) {
  Vessel vessel;
  vessel.steps(3, 1e-3);
  vessel.steps(3, 2e-3);
  const VectorXd state = vessel.solver.state();
  const double time = vessel.time;
  run_on(vessel);
  const VectorXd end = vessel.solver.state();
  put(vessel, state, time, 4e6);
  run_on(vessel);
  EXPECT_EQ(vessel.solver.state(), end);
}

/// What a filter sets: neither state's factor, and a mixture of its bookkeeping that means nothing.
TEST(SolidSolver, AMixtureOfStatesContinuesFromItsMotion) {
  Vessel one, other;
  one.steps(6), other.steps(4, 3e-3);
  const VectorXd mixture = 2.5 * one.solver.state() - 1.5 * other.solver.state();
  Vessel fresh, used;
  used.steps(3);
  for (Vessel* vessel : {&fresh, &used}) put(*vessel, mixture, 0.012, 4e6);
  const Points expected = 2.5 * one.solver.displacement() - 1.5 * other.solver.displacement();
  EXPECT_EQ(fresh.solver.displacement(), expected);
  fresh.steps(3), used.steps(3);
  EXPECT_LE(relative(fresh.solver.displacement(), used.solver.displacement()), 1e-9);
}

TEST(SolidSolver, AStateOfTheWrongSizeIsRefused) {
  Vessel vessel;
  EXPECT_THROW(vessel.solver.set_state(VectorXd::Zero(7)), InputError);
}

TEST(WallParameters, EachChangesItsForce) {
  Vessel vessel;
  vessel.steps(2);
  const Points y = vessel.solver.displacement(), u = vessel.solver.velocity();
  const auto forces = [&] { return vessel.model.step_forces(y, 0.9 * u, u, 0.01, 1e-3, nullptr); };
  const VectorXd before = forces();
  for (const ParameterTable::Entry& entry : vessel.model.parameters().entries()) {
    const double value = entry.value();
    vessel.model.parameters().set(entry.name, value == 0 ? 1.0 : 1.01 * value);
    EXPECT_NE(forces(), before) << entry.name;
    vessel.model.parameters().set(entry.name, value);
    EXPECT_EQ(forces(), before) << entry.name;
  }
}

TEST(WallParameters, DensityScalesInertiaOnly) {
  Vessel vessel;
  const Points zero = Points::Zero(3, vessel.wall.points.cols());
  Points u = zero;
  u.row(2).setOnes();
  const auto inertia = [&] { return vessel.model.step_forces(zero, zero, 1e-9 * u, 0, 1.0, nullptr); };
  vessel.model.parameters().set("solid.support.regions.wall.stiffness", 0);
  vessel.model.parameters().set("solid.support.regions.wall.damping", 0);
  vessel.model.parameters().set("solid.rings.outlet_ring.stiffness", 0);
  vessel.model.parameters().set("solid.viscosity", 0);
  const VectorXd still = vessel.model.step_forces(zero, 1e-9 * u, 1e-9 * u, 0, 1.0, nullptr);
  const VectorXd once = inertia() - still;
  vessel.model.parameters().set("solid.density", 2.4);
  EXPECT_LE((inertia() - still - 2 * once).norm(), 1e-9 * once.norm());
}

TEST(WallParameters, AnUnknownNameIsRefusedWithTheKnownOnes) {
  Vessel vessel;
  try {
    vessel.model.parameters().set("solid.support.regions.spine.stiffness", 1);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const char* known : {"solid.density", "solid.viscosity", "solid.material.young", "solid.material.poisson",
                              "solid.support.regions.wall.stiffness", "solid.rings.outlet_ring.damping"})
      EXPECT_NE(message.find(known), std::string::npos) << message;
  }
  EXPECT_THROW(vessel.model.parameters().set("solid.density", -1), InputError);
}

TEST(WallParameters, AreSetTogetherOrNotAtAll) {
  Vessel vessel;
  const ParameterTable& table = vessel.model.parameters();
  const std::vector<double> before = table.values();
  EXPECT_THROW(table.set({"solid.density", "solid.colour"}, {2.4, 1}), InputError);
  EXPECT_THROW(table.set({"solid.colour", "solid.density"}, {1, 2.4}), InputError);
  EXPECT_THROW(table.set({"solid.material.young", "solid.density"}, {5e6, -1}), InputError);
  EXPECT_THROW(table.set({"solid.density"}, {}), InputError);
  EXPECT_EQ(table.values(), before);
  table.set({"solid.material.young", "solid.density"}, {5e6, 2.4});
  EXPECT_NE(table.values(), before);
}

TEST(WallModel, EnergyConservationNeedsTheMidpoint) {
  const WallMesh wall = circular_tube(2, 2, 0.2, 8, 3).wall;
  WallSettings settings = Vessel::settings(true);
  settings.theta = 0.55;
  EXPECT_THROW(WallModel(wall, settings, wall.points, {}, {}), InputError);
}

}  // namespace
}  // namespace tether
