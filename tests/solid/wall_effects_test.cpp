// Parts of the wall that differ: the contract of every such effect, then laws with known answers.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "solid/element_places.hpp"
#include "solid/materials/registry.hpp"
#include "solid/solid_solver.hpp"
#include "solid/vessel_direction.hpp"
#include "solid/wall_effects/registry.hpp"
#include "tests/solid/strains.hpp"
#include "tests/solid/tube.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace wall_effects_test {

const std::vector<double> rubber_values{2.0, 0.3};

std::unique_ptr<Material> rubber(double factor = 1) {
  return neo_hookean.make(std::vector{factor * rubber_values[0], rubber_values[1]});
}

WallLocal local_of(const std::string& type, const std::map<std::string, double>& values) {
  WallLocal local;
  Configured<WallEffect>(wall_effects(), {type, values})->apply(local);
  return local;
}

Configured<WallEffect> configured(const std::string& type, const std::map<std::string, double>& values) {
  return {wall_effects(), {type, values}};
}

/// The elements of a wall, all of it different in this way.
std::unique_ptr<WallElements> elements_with(const WallMesh& wall, const WallLocal& local) {
  auto elements = make_wall_elements(wall, wall.points);
  elements->set_places(element_places(wall, wall.outside, place_along_vessel(wall)).of_elements);
  elements->set_local(std::vector<WallLocal>(wall.outside.size(), local));
  return elements;
}

VectorXd force_at(const WallElements& elements, const Points& x, const Material& material,
                  SparseMatrix* tangent = nullptr) {
  VectorXd force = VectorXd::Zero(x.size());
  elements.static_force(x, material, force, tangent);
  return force;
}

class WallEffectContract : public ::testing::TestWithParam<std::tuple<int, ElementKind>> {
 protected:
  const Registered<WallEffect>& entry() const {
    return wall_effects()[static_cast<std::size_t>(std::get<0>(GetParam()))];
  }
  WallMesh wall() const { return with_elements(irregular_plate(3), std::get<1>(GetParam())); }
  /// Values of order one, in range.
  WallLocal local() const {
    std::vector<double> values;
    for (const Parameter& p : entry().declaration.parameters) values.push_back(p.name == "angle" ? 35 : 1.3);
    WallLocal result;
    entry().make(values)->apply(result);
    return result;
  }
  Random random_{7};
};

TEST_P(WallEffectContract, AbsentValuesLeaveThePlainWall) {
  std::vector<double> absent;
  for (const Parameter& p : entry().declaration.parameters) {
    absent.push_back(std::isnan(p.absent) ? 0.3 : p.absent);
    if (std::isnan(p.absent)) continue;
    EXPECT_TRUE(p.range.contains(p.absent));
    EXPECT_GT(p.prior_deviation, 0);
    EXPECT_GT(p.scale, 0);
  }
  WallLocal result;
  entry().make(absent)->apply(result);
  EXPECT_TRUE(result.is_plain());
  EXPECT_FALSE(local().is_plain());
}

TEST_P(WallEffectContract, ForceIsTheDerivativeOfTheEnergyAndTheTangentThatOfTheForce) {
  const WallMesh mesh = wall();
  const auto elements = elements_with(mesh, local());
  const auto material = rubber();
  const Points x = mesh.points + 0.05 * random_.matrix(3, mesh.points.cols()), d = random_.matrix(3, x.cols());
  SparseMatrix tangent = elements->zero_matrix();
  const VectorXd force = force_at(*elements, x, *material, &tangent);
  EXPECT_LE((force - force_at(*elements, x, *material)).norm(), 1e-12 * force.norm());
  const double power = derivative([&](double t) { return elements->energy(x + t * d, *material); }, 2e-4);
  EXPECT_NEAR(force.dot(d.reshaped()), power, 1e-8 * force.norm() * d.norm());
  const VectorXd change = derivative([&](double t) { return force_at(*elements, x + t * d, *material); }, 2e-4);
  EXPECT_LE((tangent * d.reshaped() - change).norm(), 1e-8 * change.norm());
  EXPECT_LE((tangent - SparseMatrix(tangent.transpose())).norm(), 1e-13 * tangent.norm());
}

TEST_P(WallEffectContract, ARigidMotionCostsNothing) {
  const WallMesh mesh = wall();
  const auto elements = elements_with(mesh, local());
  const Points moved = (random_rotation(random_) * mesh.points).colwise() + Vec3(0.3, -2, 1);
  EXPECT_NEAR(elements->energy(moved, *rubber()), elements->energy(mesh.points, *rubber()), 1e-12 * elements->volume());
}

TEST_P(WallEffectContract, ConservesEnergyWhereTheStepDoes) {
  const WallMesh mesh = wall();
  const auto elements = elements_with(mesh, local());
  const auto material = rubber();
  const Points start = mesh.points + 0.05 * random_.matrix(3, mesh.points.cols()),
               v = 0.1 * random_.matrix(3, start.cols()), none = Points::Zero(3, start.cols());
  VectorXd force = VectorXd::Zero(start.size());
  elements->step_force({start, v, none, 0.5, 1.0, true}, {&*material, 0, 0}, force, nullptr);
  const double stored = elements->energy(start + v, *material) - elements->energy(start, *material);
  EXPECT_NEAR(force.dot(v.reshaped()), stored, 1e-11 * std::abs(stored));
}

INSTANTIATE_TEST_SUITE_P(Registry, WallEffectContract,
                         testing::Combine(::testing::Range(0, static_cast<int>(wall_effects().size())),
                                          ::testing::Values(ElementKind::prism, ElementKind::tetrahedron)),
                         [](const auto& info) {
                           return wall_effects()[static_cast<std::size_t>(std::get<0>(info.param))].declaration.name +
                                  "_" + name_of(std::get<1>(info.param));
                         });

TEST(StiffnessFactor, IsThatOfTheModulus) {
  const WallMesh wall = circular_tube(2, 2, 0.2, 12, 3).wall;
  Random random(5);
  const Points x = wall.points + 0.02 * random.matrix(3, wall.points.cols());
  const VectorXd twice = force_at(*elements_with(wall, local_of("stiffness_factor", {{"factor", 2}})), x, *rubber());
  const VectorXd expected = force_at(*make_wall_elements(wall, wall.points), x, *rubber(2));
  EXPECT_LE((twice - expected).norm(), 1e-9 * expected.norm());
}

TEST(StiffnessFactor, ActsInItsRegionOnly) {
  WallMesh wall = plate({8, 2, 0.5}, {8, 2}, 1);
  Patch right{"right", {}};
  std::erase_if(wall.outside[0].triangles, [&](const Triangle& t) {
    const bool moves = (wall.points(0, t[0]) + wall.points(0, t[1]) + wall.points(0, t[2])) / 3 > 4;
    if (moves) right.triangles.push_back(t);
    return moves;
  });
  wall.outside.push_back(right);
  auto elements = make_wall_elements(wall, wall.points);
  elements->set_places(element_places(wall, wall.outside, {}).of_elements);
  elements->set_local({WallLocal{}, local_of("stiffness_factor", {{"factor", 3}})});
  Random random(6);
  const Points x = wall.points + 0.05 * random.matrix(3, wall.points.cols());
  const VectorXd mixed = force_at(*elements, x, *rubber()),
                 plain = force_at(*make_wall_elements(wall, wall.points), x, *rubber());
  for (Eigen::Index node = 0; node < x.cols(); ++node) {
    const double place = wall.points(0, node);
    if (std::abs(place - 4) < 0.5) continue;
    EXPECT_LE((mixed.segment<3>(3 * node) - (place > 4 ? 3 : 1) * plain.segment<3>(3 * node)).norm(), 1e-12) << node;
  }
}

/// Of a uniform stretch the energy is volume times density of energy: a region counts by its share, not by elements.
TEST(StiffnessFactor, OfARegionThatCutsElementsCountsByItsShare) {
  SweepSettings settings = circular_tube_settings(2, 4, 0.2, 16, 5, 2);
  settings.regions = {{"slice", 0, 360, 0.13, 0.55}, {"rest"}};
  const WallMesh wall = sweep(settings).wall;
  auto elements = make_wall_elements(wall, wall.points);
  ElementPlaces places = element_places(wall, wall.outside, {});
  elements->set_places(places.of_elements);
  const std::vector<WallLocal> regions{local_of("stiffness_factor", {{"factor", 3}}),
                                       local_of("thickness_factor", {{"factor", 2}})};
  std::vector<WallLocal> locals = regions;
  for (const auto& shares : places.mixtures) locals.push_back(mixture(regions, shares));
  elements->set_local(locals);
  const Points x = Eigen::Vector3d(1.02, 1.02, 0.97).asDiagonal() * wall.points;
  const double plain = make_wall_elements(wall, wall.points)->energy(x, *rubber());
  EXPECT_NEAR(elements->energy(x, *rubber()) / plain, 0.42 * 3 + 0.58 * 2, 1e-9);
}

/// Two that overlap: what an element has of each counts by its share, and beside them the wall is as it was.
TEST(StiffnessFactor, ActsBetweenTwoPlacesAlongTheVessel) {
  SweepSettings settings = circular_tube_settings(2, 4, 0.2, 16, 5, 2);
  const WallMesh wall = sweep(settings).wall;
  std::vector<LocalEffect> effects;
  effects.push_back({"stiff", configured("stiffness_factor", {{"factor", 3}}), {0}, {0.13, 0.55}});
  effects.push_back({"soft", configured("stiffness_factor", {{"factor", 0.5}}), {0}, {0.4, 1}});
  const WallModel model(wall, {.material = "neo_hookean", .material_values = rubber_values, .density = 1}, wall.points,
                        {}, {}, std::move(effects));
  const Points x = Eigen::Vector3d(1.02, 1.02, 0.97).asDiagonal() * wall.points;
  const double plain = make_wall_elements(wall, wall.points)->energy(x, *rubber());
  EXPECT_NEAR(model.elements().energy(x, *rubber()) / plain, 0.13 + 0.27 * 3 + 0.15 * 1.5 + 0.45 * 0.5, 1e-9);
}

TEST(ThicknessFactor, ScalesElasticityViscosityAndMassTogether) {
  const WallMesh wall = circular_tube(2, 2, 0.2, 12, 3).wall;
  Random random(8);
  const Points start = wall.points + 0.02 * random.matrix(3, wall.points.cols()), v = random.matrix(3, start.cols()),
               a = random.matrix(3, start.cols());
  const auto material = rubber();
  const auto step = [&](const WallElements& elements) {
    VectorXd force = VectorXd::Zero(start.size());
    elements.step_force({start, v, a, 0.5, 1e-2, false}, {&*material, 0.3, 1.7}, force, nullptr);
    return force;
  };
  const VectorXd thick = step(*elements_with(wall, local_of("thickness_factor", {{"factor", 1.5}})));
  EXPECT_LE((thick - 1.5 * step(*make_wall_elements(wall, wall.points))).norm(), 1e-12 * thick.norm());
}

/// Stretched along the vessel (x), the fibres' energy is that of their strain, in closed form.
TEST(FibreFamilies, TakeUpStrainAlongThemselves) {
  for (const ElementKind kind : {ElementKind::prism, ElementKind::tetrahedron})
    for (const double exponent : {0.0, 5.0}) {
      const WallMesh wall = with_elements(plate({4, 2, 0.5}, {4, 2}, 2), kind);
      const double angle = 30, stretch = 1.2, k = 3, c = exponent, volume = 4;
      const auto with = elements_with(wall, local_of("fibres", {{"stiffness", k}, {"angle", angle}, {"exponent", c}}));
      Points x = wall.points;
      x.row(0) *= stretch;
      const double sine = std::sin(angle * std::numbers::pi / 180), E = (stretch * stretch - 1) / 2 * sine * sine;
      const double each = c > 0 ? k / (2 * c) * (std::exp(c * E * E) - 1) : k / 2 * E * E;
      const double added = with->energy(x, *rubber()) - make_wall_elements(wall, wall.points)->energy(x, *rubber());
      EXPECT_NEAR(added, 2 * each * volume, 1e-11) << name_of(kind) << " " << c;
    }
}

/// A string: tilted sideways by a slope s, the wall under tension sigma stores sigma s^2/2 per volume.
TEST(AxialTension, ResistsGoingSidewaysLikeAString) {
  for (const ElementKind kind : {ElementKind::prism, ElementKind::tetrahedron}) {
    const WallMesh wall = with_elements(plate({4, 2, 0.5}, {4, 2}, 2), kind);
    const auto with = elements_with(wall, local_of("axial_tension", {{"stress", 7}}));
    Points x = wall.points;
    x.row(2) += 0.1 * x.row(0);
    const double added = with->energy(x, *rubber()) - make_wall_elements(wall, wall.points)->energy(x, *rubber());
    EXPECT_NEAR(added, 7 * 0.1 * 0.1 / 2 * 4, 1e-12) << name_of(kind);
  }
}

struct Tube {
  explicit Tube(std::vector<LocalEffect> effects)
      : wall(circular_tube(2, 3, 0.2, 12, 4).wall),
        model(wall, {.material = "neo_hookean", .material_values = {4e6, 0.45}, .density = 1.2, .viscosity = 500},
              wall.points, nodes_of(wall.rings[0].triangles), {}, std::move(effects)),
        solver(model) {}
  void run(double pressure) {
    const Points load = pressure_forces(wall, [&](double theta) { return pressure * (1 + 0.3 * std::cos(theta)); })
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

std::vector<LocalEffect> all_absent() {
  std::vector<LocalEffect> list;
  for (const Registered<WallEffect>& entry : wall_effects())
    list.push_back({"solid.effects." + entry.declaration.name, configured(entry.declaration.name, {}), {0}});
  return list;
}

TEST(AxialTension, LeavesTheImagedWallAtRest) {
  Tube tube(all_absent());
  tube.model.parameters().set("solid.effects.axial_tension.stress", 2e5);
  tube.run(0);
  EXPECT_LE(tube.solver.displacement().norm(), 1e-12);
}

TEST(WallEffects, AbsentOnesChangeNoBitAndEachIsFeltWhenSwitchedOn) {
  Tube plain({}), absent(all_absent());
  plain.run(1e4), absent.run(1e4);
  EXPECT_EQ(plain.solver.displacement(), absent.solver.displacement());
  for (const ParameterTable::Entry& entry : absent.model.parameters().entries()) {
    if (!entry.name.starts_with("solid.effects.") || std::isnan(entry.declaration.absent)) continue;
    Tube tube(all_absent());
    const double scale = UnitSystem::cgs().from_si(entry.declaration.scale, entry.declaration.dimension);
    tube.model.parameters().set(entry.name, entry.declaration.absent + scale);
    tube.run(1e4);
    const double change =
        (tube.solver.displacement() - plain.solver.displacement()).norm() / plain.solver.displacement().norm();
    EXPECT_GT(change, 1e-6) << entry.name;
    EXPECT_LT(change, 1) << entry.name;
    tube.model.parameters().set(entry.name, entry.declaration.absent);
    EXPECT_EQ(tube.model.step_forces(plain.solver.displacement(), plain.solver.velocity(), plain.solver.velocity(), 0,
                                     1e-3, nullptr),
              plain.model.step_forces(plain.solver.displacement(), plain.solver.velocity(), plain.solver.velocity(), 0,
                                      1e-3, nullptr));
  }
}

TEST(WallEffects, CauchyStressHoldsWhatTheyAdd) {
  const WallMesh wall = plate({4, 2, 0.5}, {4, 2}, 2);
  const auto with = elements_with(wall, local_of("axial_tension", {{"stress", 7}}));
  EXPECT_LE((with->cauchy_stress(wall.points, *rubber()).colwise() - Voigt(Voigt::Unit(0) * 7)).norm(), 1e-12);
  const auto stiff = elements_with(wall, local_of("stiffness_factor", {{"factor", 2}}));
  Points x = wall.points;
  x.row(0) *= 1.1;
  const auto plain = make_wall_elements(wall, wall.points)->cauchy_stress(x, *rubber());
  EXPECT_LE((stiff->cauchy_stress(x, *rubber()) - 2 * plain).norm(), 1e-12);
}

}  // namespace wall_effects_test
}  // namespace tether
