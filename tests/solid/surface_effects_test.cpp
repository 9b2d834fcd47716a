// What acts on the wall's surface beside springs and dampers: laws with known answers, and many on one wall.
#include <gtest/gtest.h>

#include "solid/motions/registry.hpp"
#include "solid/solid_solver.hpp"
#include "solid/supports/expression_traction.hpp"
#include "solid/supports/registry.hpp"
#include "solid/vessel_direction.hpp"
#include "tests/solid/tube.hpp"

namespace tether {
namespace surface_effects_test {

using Values = std::map<std::string, double>;

Configured<Support> effect(const std::string& type, const Values& values) {
  return {surface_effects(), {type, values}};
}

Vec3 traction_of(const std::string& type, const Values& values, const SupportPoint& point) {
  return effect(type, values)->at(point).traction;
}

TEST(Declarations, SayWhatSupportsAndVariantsAre) {
  for (const auto& entry : supports()) EXPECT_EQ(entry.declaration.role, EffectRole::holds);
  for (const auto& entry : surface_effects()) {
    const EffectDeclaration& own = entry.declaration;
    if (own.role != EffectRole::holds) {
      EXPECT_THROW(find_effect(supports(), own.name), InputError) << own.name;
    }
    if (own.variant_of.empty()) continue;
    const EffectDeclaration& other = find_effect(surface_effects(), own.variant_of).declaration;
    EXPECT_EQ(other.role, own.role) << own.name;
    EXPECT_TRUE(other.variant_of.empty()) << own.name << ": a variant of a variant";
  }
}

TEST(Contact, PushesBackOnlyWhereItTouchesAndSetsInSmoothly) {
  const Values values{{"stiffness", 100}, {"gap", 0.2}, {"smoothing", 0.1}};
  const auto push = [&](double y) {
    return traction_of("contact", values, {Vec3(3, y, 0), Vec3(0, 5, 0), Vec3(0, 1, 0)});
  };
  EXPECT_EQ(push(-1), Vec3::Zero());
  EXPECT_EQ(push(0.2), Vec3::Zero());
  EXPECT_NEAR(push(0.25)[1], -100 * 0.05 * 0.05 / (2 * 0.1), 1e-12);
  EXPECT_NEAR(push(0.3)[1], -100 * 0.05, 1e-12);
  EXPECT_NEAR(push(0.7)[1], -100 * (0.5 - 0.05), 1e-12);
  EXPECT_EQ(push(0.7)[0], 0) << "the wall slides along it";
}

TEST(Stiffening, GrowsWithTheCube) {
  const SupportPoint at{Vec3(0, 0.3, 0.4), Vec3::Zero(), Vec3(1, 0, 0)};
  EXPECT_LE((traction_of("stiffening", {{"cubic", 8}}, at) + 8 * 0.25 * Vec3(0, 0.3, 0.4)).norm(), 1e-14);
}

TEST(ExternalPressure, FollowsItsHarmonicsAfterTheRamp) {
  const Values values{{"constant", 1}, {"cosine_1", 2}, {"sine_1", 3},   {"cosine_2", 4}, {"sine_2", 5},
                      {"cosine_3", 6}, {"sine_3", 7},   {"period", 0.8}, {"ramp", 0.1}};
  const auto pressure = [&](double time) {
    SupportPoint at{Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, 1)};
    at.time = time;
    return -traction_of("external_pressure", values, at)[2];
  };
  EXPECT_EQ(pressure(0), 0);
  EXPECT_NEAR(pressure(0.8), 1 + 2 + 4 + 6, 1e-12);
  EXPECT_NEAR(pressure(0.2), 1 + 3 - 4 - 7, 1e-12) << "a quarter of the beat";
  EXPECT_NEAR(pressure(0.05), pressure(0.85) / 2, 1e-12) << "half way up the ramp";
}

constexpr double size = 10;

/// A parameter of a formula, absent at zero.
Parameter number(const char* name) {
  return {name, "", dimension::none, range::any, 0, 0};
}

TEST(ExpressionTraction, IsWhatItsFormulasSay) {
  const ExpressionLaw law{
      "-k*un - c*vn + q*sin(2*pi*t)", {"k*ux^3", "0", "q*z*nx"}, {number("k"), number("c"), number("q")}, size};
  SupportPoint p{Vec3(0.3, -0.2, 0.5), Vec3(1, 2, -1), Vec3(1, 2, 2) / 3};
  p.position = Vec3(4, 5, 6);
  p.time = 0.25;
  const double k = 7, c = 2, q = 3, un = p.displacement.dot(p.normal), vn = p.velocity.dot(p.normal);
  const SupportTraction coded = configure(law, {k, c, q})->at(p);
  EXPECT_LE((coded.traction - ((-k * un - c * vn + q) * p.normal + Vec3(k * 0.027, 0, q * 6.0 / 3))).norm(), 1e-13);
  Mat3 stiffness = k * p.normal * p.normal.transpose();
  stiffness(0, 0) -= 3 * k * 0.09;
  EXPECT_LE((coded.stiffness - stiffness).norm(), 1e-7);
  EXPECT_LE((coded.damping - c * p.normal * p.normal.transpose()).norm(), 1e-7);
}

TEST(ExpressionTraction, OnlyTheSymmetricPartOfItsTangentIsUsed) {
  const ExpressionLaw law{"", {"uy", "-ux + 2*uz", "0"}, {}, size};
  const SupportTraction coded = configure(law, {})->at({Vec3(0.3, -0.2, 0.5), Vec3::Zero(), Vec3(0, 0, 1)});
  EXPECT_EQ(coded.stiffness, coded.stiffness.transpose());
  EXPECT_NEAR(coded.stiffness(0, 1), 0, 1e-8);
  EXPECT_NEAR(coded.stiffness(1, 2), -1, 1e-8);
}

TEST(ExpressionTraction, IsAbsentWithItsParametersAndRefusesWhatIsNoFormula) {
  const Parameter k = number("k"), x = number("x");
  EXPECT_TRUE(configure({"-k*un", {}, {k}, size}, {0}).is_absent());
  EXPECT_FALSE(configure({"-k*un", {}, {k}, size}, {1}).is_absent());
  EXPECT_FALSE(configure({"-un", {}, {}, size}, {}).is_absent());
  EXPECT_THROW(configure({"-k*un", {}, {}, size}, {}), InputError);
  EXPECT_THROW(configure({"-k*un +", {}, {k}, size}, {1}), InputError);
  EXPECT_THROW(configure({"-x*un", {}, {x}, size}, {1}), InputError);
  EXPECT_THROW(configure({"-k*un - 300", {}, {k}, size}, {1}), InputError) << "something is left where it is absent";
  EXPECT_THROW(configure({"-un", {}, {k}, size}, {0}), InputError) << "its parameter does nothing";
  const SupportPoint p{Vec3(-1, 0, 0), Vec3::Zero(), Vec3(1, 0, 0)};
  EXPECT_THROW(configure({"sqrt(un + 0.5)", {}, {}, size}, {})->at(p), RunError);
  EXPECT_THROW(configure({"k/un", {}, {k}, size}, {1}), InputError) << "no value at rest";
  EXPECT_THROW(configure({"sqrt(un)", {}, {}, size}, {}), InputError) << "no slope at rest";
  EXPECT_FALSE(configure({"-k*un/(abs(x) + y*y)", {}, {k}, size}, {1}).is_absent());
}

/// A wall's surface as the effect sees it, in one step of theta dt = 0.5.
struct OnSurface {
  OnSurface(const WallMesh& wall, Configured<Support> law, const Patch& patch) : support(patch, std::move(law)) {
    support.orient(std::make_shared<const VectorXd>(place_along_vessel(wall)));
    support.attach(make_wall_elements(wall, wall.points)->zero_matrix());
    support.place(wall.points);
  }
  Points force(const Points& y, const Points& u, const Points* acceleration = nullptr) const {
    VectorXd result = VectorXd::Zero(y.size());
    support.add({y, u, 1.0, 0.5, acceleration}, result, nullptr);
    return result.reshaped(3, y.cols());
  }
  SurfaceSupport support;
};

TEST(Traction, PullsAlongTheNormalAlongTheVesselAndAroundIt) {
  const double radius = 2.2, length = 4;
  const WallMesh wall = circular_tube(2, length, 0.2, 24, 6).wall;
  const Points none = Points::Zero(3, wall.points.cols());
  const double half = std::numbers::pi / 24, area = 24 * 2 * radius * std::sin(half) * length;
  const auto forces = [&](const char* amplitude) {
    return OnSurface(wall, effect("traction", {{amplitude, 3}, {"period", 0.8}}), wall.outside[0]).force(none, none);
  };
  const auto torque = [&](const Points& f) {
    return (wall.points.row(0).cwiseProduct(f.row(1)) - wall.points.row(1).cwiseProduct(f.row(0))).sum();
  };
  const Points normal = forces("normal_constant"), axial = forces("axial_constant"), around = forces("around_constant");
  const Eigen::MatrixXd outward = wall.points.topRows<2>().colwise().normalized();
  EXPECT_NEAR(normal.topRows<2>().cwiseProduct(outward).sum(), 3 * area * std::cos(half), 1e-10 * area);
  EXPECT_LE((axial.rowwise().sum() - 3 * area * Vec3(0, 0, 1)).norm(), 1e-10 * area);
  EXPECT_NEAR(torque(around), 3 * area * radius * std::cos(half), 1e-8 * area);
  for (const Points& f : {normal, around}) EXPECT_LE(f.rowwise().sum().norm(), 1e-8 * area) << "nothing pulls sideways";
  EXPECT_NEAR(torque(axial), 0, 1e-8 * area);
}

TEST(VesselDirection, GrowsLinearlyAlongAStraightTube) {
  const WallMesh wall = circular_tube(2, 4, 0.2, 16, 8).wall;
  EXPECT_LE((place_along_vessel(wall) - wall.points.row(2).transpose() / 4).lpNorm<Eigen::Infinity>(), 1e-12);
  WallMesh closed = wall;
  closed.rings.pop_back();
  EXPECT_THROW(place_along_vessel(closed), InputError);
}

/// Over a step the tissue's work is the change of its kinetic energy, exactly.
TEST(TissueMass, TakesTheWorkThatItHoldsAsKineticEnergy) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  const OnSurface tissue(wall, effect("tissue_mass", {{"mass", 1.7}}), wall.outside[0]);
  Random random(3);
  const Points y = random.matrix(3, wall.points.cols()), u0 = random.matrix(3, y.cols()),
               u1 = random.matrix(3, y.cols());
  const double dt = 1;
  const Points V = (u0 + u1) / 2, acceleration = (V - u0) / 0.5;
  const auto kinetic = [&](const Points& u) { return -0.5 * u.cwiseProduct(tissue.force(y, u, &u)).sum(); };
  const double work = dt * V.cwiseProduct(tissue.force(y, V, &acceleration)).sum();
  EXPECT_NEAR(work, kinetic(u0) - kinetic(u1), 1e-12 * kinetic(u0));
  const Points one = Points::Ones(3, y.cols());
  EXPECT_NEAR(kinetic(one), 0.5 * 1.7 * 6 * 3, 1e-12) << "area 6, each of three components";
}

struct Plate {
  Plate(std::vector<SurfaceSupport> surface, std::vector<int> clamped = {}, double theta = 0.5)
      : model(plate({3, 2, 0.5}, {3, 2}, 1),
              {.material = "neo_hookean", .material_values = {50.0, 0.3}, .density = 1.5, .theta = theta},
              plate({3, 2, 0.5}, {3, 2}, 1).points, std::move(clamped), std::move(surface)),
        solver(model) {}
  /// Steps under a uniform traction with this resultant.
  void pull(const Vec3& total, int steps, double dt) {
    const WallMesh& wall = model.mesh();
    Points load = Points::Zero(3, wall.interface_nodes);
    for (const Triangle& t : wall.interface)
      for (int node : t) load.col(node) += total / (3.0 * static_cast<double>(wall.interface.size()));
    for (int step = 0; step < steps; ++step) {
      solver.begin_step(dt * step, dt);
      solver.evaluate(load);
      solver.accept();
    }
  }
  WallModel model;
  SolidSolver solver;
};

std::vector<SurfaceSupport> list_of(SurfaceSupport support) {
  std::vector<SurfaceSupport> list;
  list.push_back(std::move(support));
  return list;
}

TEST(TissueMass, MakesAFreeWallHeavier) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  Plate plate(list_of({wall.outside[0], effect("tissue_mass", {{"mass", 2.5}})}));
  const Vec3 total(0.03, -0.02, 0);
  plate.pull(total, 40, 0.1);
  const double time = 4;
  Vec3 tissue = Vec3::Zero(), wall_mean = Vec3::Zero();  // momentum of each
  for (const Triangle& t : wall.outside[0].triangles)
    for (int node : t)
      tissue += 2.5 * 6 / (3.0 * double(wall.outside[0].triangles.size())) * plate.solver.velocity().col(node);
  const WallMaterial matter{&plate.model.material(), 0, 1.5};
  const Points& u = plate.solver.velocity();
  const Points none = Points::Zero(3, u.cols());
  VectorXd momentum = VectorXd::Zero(u.size());
  plate.model.elements().step_force({wall.points, none, u, 0.5, 1.0, false}, matter, momentum, nullptr);
  wall_mean = momentum.reshaped(3, u.cols()).rowwise().sum();
  EXPECT_LE((tissue + wall_mean - total * time).norm(), 1e-8 * total.norm() * time) << "momentum is load times time";
}

TEST(LooseRing, IsClampedWithoutComplianceAndYieldsByItInEquilibrium) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  const std::vector<int> ring = nodes_of(wall.rings[0].triangles);
  Plate plate(list_of({wall.rings[0], effect("loose_ring", {}), {}, "solid.effects.loose"}), {}, 1.0);
  EXPECT_EQ(plate.model.clamped_unknowns(), unknowns_of(ring));
  plate.pull(Vec3(0.03, 0, 0), 3, 1);
  for (int node : ring) EXPECT_EQ(plate.solver.displacement().col(node), Vec3::Zero());

  const double compliance = 0.2, area = 2 * 0.5;
  plate.model.parameters().set("solid.effects.loose.compliance", compliance);
  EXPECT_TRUE(plate.model.clamped_unknowns().empty());
  plate.pull(Vec3(0.03, 0, 0), 60, 100);
  EXPECT_LE((plate.solver.support_forces()[0] + Vec3(0.03, 0, 0)).norm(), 1e-7);
  double mean = 0;
  for (const Triangle& t : wall.rings[0].triangles)
    for (int node : t) mean += plate.solver.displacement()(0, node) / (3.0 * double(wall.rings[0].triangles.size()));
  EXPECT_NEAR(mean, 0.03 / area * compliance, 1e-6 * mean);

  plate.model.parameters().set("solid.effects.loose.compliance", 0);
  const Points before = plate.solver.displacement();
  plate.pull(Vec3(0.06, 0, 0), 1, 1);
  for (int node : ring) EXPECT_EQ(plate.solver.displacement().col(node), before.col(node)) << "stays where it is";
}

TEST(LooseRing, AStiffOneIsNearlyAClamp) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  Plate clamped({}, nodes_of(wall.rings[0].triangles)),
      stiff(list_of({wall.rings[0], effect("loose_ring", {{"compliance", 1e-8}})}));
  for (Plate* plate : {&clamped, &stiff}) plate->pull(Vec3(0.03, 0.01, 0.002), 20, 0.1);
  EXPECT_LE((clamped.solver.displacement() - stiff.solver.displacement()).norm(),
            1e-5 * clamped.solver.displacement().norm());
}

std::shared_ptr<MovingTissue> breathing_tissue(const Values& values) {
  return std::make_shared<MovingTissue>(
      MovingTissue{"solid.effects.breathing", Configured<MotionLaw>(motions(), {"breathing", values}), TissueMotion{}});
}

TEST(Breathing, CarriesAHeldWallAlong) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  SurfaceSupport spring(wall.outside[0], effect("visco_elastic", {{"stiffness", 100}}));
  spring.follow(breathing_tissue({{"amplitude_x", 0.1}, {"amplitude_z", -0.05}, {"period", 400}, {"phase", 0.1}}));
  Plate plate(list_of(std::move(spring)), {}, 1.0);
  plate.pull(Vec3::Zero(), 160, 0.5);
  const double angle = 2 * std::numbers::pi * (80.0 / 400 + 0.1), start = 2 * std::numbers::pi * 0.1;
  const Vec3 expected = (std::sin(angle) - std::sin(start)) * Vec3(0.1, 0, -0.05);
  const Points& y = plate.solver.displacement();
  EXPECT_LE((y.colwise() - expected).colwise().norm().maxCoeff(), 0.01 * expected.norm());
}

TEST(Motions, AreAtRestAtTheStartAndWhenAbsent) {
  const TissueMotion measured = [](double t) { return AffineDisplacement{Vec3(t, 0, t * t), t * Mat3::Ones()}; };
  for (const Registered<MotionLaw>& entry : motions()) {
    std::vector<double> values, absent;
    for (const Parameter& p : entry.declaration.parameters) {
      values.push_back(0.3);
      absent.push_back(std::isnan(p.absent) ? 0.3 : p.absent);
    }
    const Vec3 x(0.1, 0.2, 0.3);
    EXPECT_EQ(entry.make(values)->at(0, measured).at(x), Vec3::Zero()) << entry.declaration.name;
    EXPECT_GT(entry.make(values)->at(0.05, measured).at(x).norm(), 0) << entry.declaration.name;
    EXPECT_EQ(entry.make(absent)->at(0.7, measured).at(x), Vec3::Zero()) << entry.declaration.name;
    EXPECT_TRUE(Configured<MotionLaw>(motions(), entry.declaration.name, absent).is_absent());
  }
  const std::vector<double> twice{2.0};
  EXPECT_EQ(measured_motion.make(twice)->at(3, measured).at(Vec3(1, 0, 0)), Vec3(12, 6, 24));
}

/// A tube on springs, with as many effects beside as there are kinds, all absent, or none.
struct Tube {
  explicit Tube(bool with_effects)
      : wall(circular_tube(2, 2, 0.2, 8, 3).wall),
        model(wall, settings(), wall.points, clamped(with_effects), surface(with_effects)),
        solver(model) {}
  static WallSettings settings() {
    return {.material = "neo_hookean", .material_values = {4e6, 0.45}, .density = 1.2, .viscosity = 500};
  }
  std::vector<int> clamped(bool with_effects) const {
    return nodes_of(with_effects ? wall.rings[1].triangles : [&] {
      auto both = wall.rings[1].triangles;
      both.insert(both.end(), wall.rings[0].triangles.begin(), wall.rings[0].triangles.end());
      return both;
    }());
  }
  std::vector<SurfaceSupport> surface(bool with_effects) const {
    std::vector<SurfaceSupport> list;
    list.emplace_back(wall.outside[0], effect("visco_elastic", {{"stiffness", 1e5}, {"damping", 1e3}}));
    if (!with_effects) return list;
    list[0].follow(breathing_tissue({{"period", 4}}));
    for (const Registered<Support>& entry : surface_effects()) {
      std::vector<double> values;
      for (const Parameter& p : entry.declaration.parameters)
        values.push_back(p.name == "gap" ? 0 : std::isnan(p.absent) ? 0.4 : p.absent);
      const std::string& name = entry.declaration.name;
      Patch patch = name == "loose_ring" ? wall.rings[0] : wall.outside[0];
      patch.name = name;
      list.emplace_back(patch, Configured<Support>(surface_effects(), name, values), TissueMotion{},
                        "solid.effects." + name);
    }
    return list;
  }
  void run() {
    const Points load = pressure_forces(wall, [](double theta) { return 1e4 * (1 + 0.3 * std::cos(theta)); })
                            .reshaped(3, wall.points.cols())
                            .leftCols(wall.interface_nodes);
    for (int step = 0; step < 4; ++step) {
      solver.begin_step(2e-3 * step, 2e-3);
      solver.evaluate(load);
      solver.accept();
    }
  }
  WallMesh wall;
  WallModel model;
  SolidSolver solver;
};

/// A formula for a spring does what the spring does.
TEST(ExpressionTraction, ReplacesARegisteredEffect) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  const Parameter k = number("k"), c = number("c");
  Plate spring(list_of({wall.outside[0], effect("normal_visco_elastic", {{"stiffness", 3}, {"damping", 0.4}})}),
               nodes_of(wall.rings[0].triangles));
  Plate formula(list_of({wall.outside[0], configure({"-k*un - c*vn", {}, {k, c}, 3}, {3, 0.4}), {}, "solid.effects.f"}),
                nodes_of(wall.rings[0].triangles));
  for (Plate* plate : {&spring, &formula}) plate->pull(Vec3(0.1, 0.1, 0.2), 10, 0.1);
  EXPECT_LE((spring.solver.displacement() - formula.solver.displacement()).norm(),
            1e-8 * spring.solver.displacement().norm());
  formula.model.parameters().set("solid.effects.f.k", 5);
}

TEST(ManyEffects, AbsentOnesChangeNoBit) {
  Tube plain(false), many(true);
  plain.run(), many.run();
  EXPECT_EQ(plain.solver.displacement(), many.solver.displacement());
  EXPECT_EQ(plain.solver.velocity(), many.solver.velocity());
}

TEST(ManyEffects, EachIsFeltWhenSwitchedOnWhileTheOthersAreThere) {
  Tube plain(false);
  plain.run();
  std::vector<std::string> names;
  const Tube all(true);
  for (const ParameterTable::Entry& entry : all.model.parameters().entries())
    if (entry.name.starts_with("solid.effects.") && !std::isnan(entry.declaration.absent)) names.push_back(entry.name);
  EXPECT_GE(names.size(), 35U);
  for (const std::string& name : names) {
    Tube tube(true);
    for (const auto& entry : tube.model.parameters().entries())
      if (entry.name == name) {
        const double scale =
            std::isnan(entry.declaration.scale) ? entry.declaration.prior_deviation : entry.declaration.scale;
        tube.model.parameters().set(name, UnitSystem::cgs().from_si(scale, entry.declaration.dimension));
      }
    tube.run();
    const double change =
        (tube.solver.displacement() - plain.solver.displacement()).norm() / plain.solver.displacement().norm();
    EXPECT_GT(change, 1e-9) << name;
    EXPECT_LT(change, 2) << name << ": its scale is too large";
  }
}

}  // namespace surface_effects_test
}  // namespace tether
