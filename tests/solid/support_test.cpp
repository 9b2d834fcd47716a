#include <gtest/gtest.h>

#include "solid/solid_solver.hpp"
#include "solid/supports/registry.hpp"
#include "tests/solid/strains.hpp"
#include "tests/solid/tube.hpp"

// Supports: the contract of every one, then what they do on a wall.
namespace tether {
namespace {

class SupportContract : public ::testing::TestWithParam<int> {
 protected:
  const Registered<Support>& entry() const { return surface_effects()[static_cast<std::size_t>(GetParam())]; }
  std::unique_ptr<Support> with(double factor) const {
    std::vector<double> values;
    for (const Parameter& parameter : entry().declaration.parameters)
      values.push_back(parameter.name == "gap" ? 0 : factor * (2.0 + 0.7 * double(values.size())));
    return entry().make(values);
  }
  SupportPoint point() {
    SupportPoint p{vector(), vector(), vector().normalized()};
    p.acceleration = vector();
    p.axial = p.normal.cross(vector()).normalized();
    p.position = vector();
    p.time = 0.4;
    return p;
  }
  Vec3 vector() { return random_.matrix(3, 1); }
  Random random_{11};
};

TEST_P(SupportContract, AbsentValuesExertNothing) {
  std::vector<double> absent;
  for (const Parameter& parameter : entry().declaration.parameters)
    absent.push_back(std::isnan(parameter.absent) ? 0.3 : parameter.absent);
  EXPECT_TRUE(Configured<Support>(surface_effects(), entry().declaration.name, absent).is_absent());
  const SupportTraction traction = entry().make(absent)->at(point());
  EXPECT_EQ(traction.traction, Vec3::Zero());
  EXPECT_EQ(traction.stiffness, Mat3::Zero());
  EXPECT_EQ(traction.damping, Mat3::Zero());
  EXPECT_EQ(traction.inertia, Mat3::Zero());
}

/// What identification and diagnosis need: a scale for whatever can be switched on, and a prior for it.
TEST_P(SupportContract, WhatCanBeAbsentHasAScale) {
  for (const Parameter& parameter : entry().declaration.parameters) {
    if (std::isnan(parameter.absent)) continue;
    EXPECT_TRUE(parameter.range.contains(parameter.absent)) << parameter.name;
    EXPECT_GT(parameter.prior_deviation, 0) << parameter.name;
    EXPECT_TRUE(parameter.scale > 0 || parameter.transform == Transform::linear) << parameter.name;
  }
}

/// Differences of fourth order: exact but for rounding of a polynomial of degree four; of another law their error falls
/// by 16 where the step is halved, and of a wrong tangent it stays.
TEST_P(SupportContract, StiffnessDampingAndInertiaAreTheDerivatives) {
  constexpr double rounding = 1e-11, step = 1e-2;
  const auto support = with(1);
  for (int sample = 0; sample < 10; ++sample) {
    const SupportPoint at = point();
    const SupportTraction coded = support->at(at);
    for (int i = 0; i < 3; ++i) {
      const auto error = [&](const Mat3& tangent, Vec3 SupportPoint::*member, double h) {
        const auto moved = [&](double t) {
          SupportPoint p = at;
          p.*member += t * Vec3::Unit(i);
          return support->at(p).traction;
        };
        return (tangent.col(i) + derivative(moved, h)).norm();
      };
      for (const auto& [tangent, member] :
           {std::pair(coded.stiffness, &SupportPoint::displacement), std::pair(coded.damping, &SupportPoint::velocity),
            std::pair(coded.inertia, &SupportPoint::acceleration)})
        EXPECT_LE(error(tangent, member, step / 2), std::max(rounding, error(tangent, member, step) / 12));
    }
  }
}

TEST_P(SupportContract, TangentsAreSymmetric) {
  const SupportTraction coded = with(1)->at(point());
  for (const Mat3& tangent : {coded.stiffness, coded.damping, coded.inertia}) EXPECT_EQ(tangent, tangent.transpose());
}

class HoldingContract : public SupportContract {};

TEST_P(HoldingContract, HoldsAndDampsNeverDrives) {
  const auto support = with(1);
  for (int sample = 0; sample < 20; ++sample) {
    SupportPoint at = point();
    const SupportTraction coded = support->at(at);
    const Vec3 any = vector();
    EXPECT_GE(any.dot(coded.stiffness * any), 0);
    EXPECT_GE(any.dot(coded.damping * any), 0);
    EXPECT_GE(any.dot(coded.inertia * any), 0);
    at.displacement.setZero();
    at.acceleration.setZero();
    EXPECT_LE(support->at(at).traction.dot(at.velocity), 0) << "power of the damper";
    std::swap(at.displacement, at.velocity);
    EXPECT_LE(support->at(at).traction.dot(at.displacement), 0);
  }
}

TEST_P(SupportContract, KnowsNoPreferredDirectionButTheNormal) {
  const SupportPoint at = point();
  const Mat3 turn = random_rotation(random_);
  SupportPoint turned = at;
  for (Vec3 SupportPoint::*member : {&SupportPoint::displacement, &SupportPoint::velocity, &SupportPoint::normal,
                                     &SupportPoint::acceleration, &SupportPoint::axial, &SupportPoint::position})
    turned.*member = turn * at.*member;
  EXPECT_LE((with(1)->at(turned).traction - turn * with(1)->at(at).traction).norm(), 1e-13);
}

std::string name_of_entry(const ::testing::TestParamInfo<int>& info) {
  return surface_effects()[static_cast<std::size_t>(info.param)].declaration.name;
}
INSTANTIATE_TEST_SUITE_P(Registry, SupportContract, ::testing::Range(0, static_cast<int>(surface_effects().size())),
                         name_of_entry);
INSTANTIATE_TEST_SUITE_P(Registry, HoldingContract, ::testing::Range(0, static_cast<int>(supports().size())),
                         name_of_entry);

constexpr double stiffness = 3.0, damping = 0.4;

SurfaceSupport support_on(const Patch& patch, const char* type = "visco_elastic", TissueMotion motion = {}) {
  SurfaceSupport support(patch,
                         Configured<Support>(supports(), {type, {{"stiffness", stiffness}, {"damping", damping}}}),
                         std::move(motion));
  return support;
}

std::vector<SurfaceSupport> only(SurfaceSupport support) {
  std::vector<SurfaceSupport> list;
  list.push_back(std::move(support));
  return list;
}

/// Force on the top of a plate of area 6 that moves as a whole.
Vec3 force_on_moving_plate(const char* type, const Vec3& displacement, const Vec3& velocity) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  SurfaceSupport support = support_on(wall.outside[0], type);
  support.attach(make_wall_elements(wall, wall.points)->zero_matrix());
  support.place(wall.points);
  const Points y = displacement.replicate(1, wall.points.cols()), u = velocity.replicate(1, wall.points.cols());
  const SupportStep step{y, u, 0, 0};
  VectorXd force = VectorXd::Zero(wall.points.size());
  support.add(step, force, nullptr);
  const Vec3 total = force.reshaped(3, wall.points.cols()).rowwise().sum();
  EXPECT_LE((total - support.resultant(step)).norm(), 1e-12);
  return total;
}

TEST(SurfaceSupport, ForceOnAMovingPlateIsAreaTimesTraction) {
  const Vec3 y(0.1, -0.2, 0.3), u(2, 1, -1);
  EXPECT_LE((force_on_moving_plate("visco_elastic", y, u) + 6 * (stiffness * y + damping * u)).norm(), 1e-12);
  const Vec3 normal = -6 * (stiffness * y[2] + damping * u[2]) * Vec3(0, 0, 1);
  EXPECT_LE((force_on_moving_plate("normal_visco_elastic", y, u) - normal).norm(), 1e-12);
}

TEST(SurfaceSupport, TangentIsTheDerivativeByTheVelocity) {
  const WallMesh wall = with_elements(plate({3, 2, 0.5}, {3, 2}, 1), ElementKind::tetrahedron);
  Random random(2);
  const Points y = random.matrix(3, wall.points.cols()), u = random.matrix(3, wall.points.cols());
  const Points direction = random.matrix(3, wall.points.cols());
  for (const Patch& patch : {wall.outside[0], wall.rings[0]}) {
    SurfaceSupport support = support_on(patch);
    SparseMatrix tangent = make_wall_elements(wall, wall.points)->zero_matrix();
    support.attach(tangent);
    support.place(wall.points);
    const double advance = 0.3;
    const auto force_at = [&](const Points& velocity, SparseMatrix* matrix) {
      VectorXd force = VectorXd::Zero(wall.points.size());
      const Points middle = y + advance * velocity;
      support.add({middle, velocity, 0, advance}, force, matrix);
      return force;
    };
    force_at(u, &tangent);
    const VectorXd slope = derivative([&](double t) { return force_at(u + t * direction, nullptr); }, 1e-2);
    EXPECT_LE((tangent * direction.reshaped() + slope).norm(), 1e-11 * slope.norm());
    EXPECT_LE((tangent - SparseMatrix(tangent.transpose())).norm(), 1e-14 * tangent.norm());
  }
}

TEST(SurfaceSupport, AnIrregularDisplacementIsIntegratedExactly) {
  const WallMesh wall = plate({1, 1, 0.5}, {1, 1}, 1);
  SurfaceSupport support = support_on(wall.outside[0]);
  support.attach(make_wall_elements(wall, wall.points)->zero_matrix());
  support.place(wall.points);
  const Points u = Points::Zero(3, wall.points.cols());
  Points y = u;
  y.row(0) = wall.points.row(0).array();  // y_x = x: int x . x dA over the unit square is 1/3
  VectorXd force = VectorXd::Zero(wall.points.size());
  support.add({y, u, 0, 0}, force, nullptr);
  EXPECT_NEAR(force.dot(y.reshaped()), -stiffness / 3, 1e-14);
}

/// The part x < 0.3 of the unit square's two triangles: borders cut both.
Patch left_of(const Patch& square, double border, const WallMesh& wall) {
  Patch part{square.name, square.triangles};
  for (const Triangle& t : square.triangles) {
    const Vec3 x = wall.points(0, t).transpose();
    const bool only_one_left = (x.array() < 0.5).count() == 1;
    Eigen::Index alone = 0;
    only_one_left ? x.minCoeff(&alone) : x.maxCoeff(&alone);
    const Eigen::Index next = (alone + 1) % 3, last = (alone + 2) % 3;
    const auto at_border = [&](Eigen::Index a, Eigen::Index b) -> Vec3 {
      const double share = (border - x[a]) / (x[b] - x[a]);
      return (1 - share) * Vec3::Unit(a) + share * Vec3::Unit(b);
    };
    const Vec3 p = at_border(alone, next), q = at_border(alone, last);
    TrianglePart tip{t}, first{t}, second{t};
    tip.corners << Vec3::Unit(alone), p, q;
    first.corners << p, Vec3::Unit(next), Vec3::Unit(last);
    second.corners << p, Vec3::Unit(last), q;
    if (x[alone] < border) part.parts.push_back(tip);
    if (x[alone] > border) part.parts.insert(part.parts.end(), {first, second});
  }
  return part;
}

TEST(SurfaceSupport, APatchWhoseBorderCutsTrianglesIsIntegratedExactly) {
  const WallMesh wall = plate({1, 1, 0.5}, {1, 1}, 1);
  constexpr double border = 0.3;
  SurfaceSupport support = support_on(left_of(wall.outside[0], border, wall));
  SparseMatrix tangent = make_wall_elements(wall, wall.points)->zero_matrix();
  support.attach(tangent);
  support.place(wall.points);
  const Points u = Points::Zero(3, wall.points.cols());
  Points y = u;
  y.row(0) = wall.points.row(0).array();  // y_x = x: int x . x dA up to the border is border^3 / 3
  VectorXd force = VectorXd::Zero(wall.points.size());
  constexpr double advance = 0.5;
  support.add({y, u, 0, advance}, force, &tangent);
  EXPECT_NEAR(force.dot(y.reshaped()), -stiffness * std::pow(border, 3) / 3, 1e-14);
  EXPECT_NEAR(support.resultant({y, u, 0, 0})[0], -stiffness * border * border / 2, 1e-14);
  const double slope = y.reshaped().dot(tangent * y.reshaped());
  EXPECT_NEAR(slope, (advance * stiffness + damping) * std::pow(border, 3) / 3, 1e-14);
  SparseMatrix K = make_wall_elements(wall, wall.points)->zero_matrix();
  support.add_stiffness(K);
  EXPECT_NEAR(y.reshaped().dot(K * y.reshaped()), stiffness * std::pow(border, 3) / 3, 1e-14);
}

/// A tube inflated to twice its outer radius, ends at rest: reference area against current area is a factor of two.
TEST(SurfaceSupport, AreaIsThatOfTheImageUnlessTheCaseSaysCurrent) {
  const WallMesh wall = circular_tube(1.8, 4, 0.2, 24, 4).wall;
  Points y = wall.points;
  y.row(2).setZero();  // twice the radius
  const Points u = y;
  double power[2];
  for (const bool current : {false, true}) {
    WallSettings settings{
        .material = "neo_hookean", .material_values = {1.0, 0.3}, .density = 1, .support_on_current_area = current};
    WallModel model(wall, settings, wall.points, {}, only(support_on(wall.outside[0])));
    model.place_supports(y);
    VectorXd force = VectorXd::Zero(wall.points.size());
    model.supports()[0].add({y, u, 0, 0}, force, nullptr);
    power[current] = force.dot(u.reshaped());
  }
  const double half = std::numbers::pi / 24, area = 24 * 2 * 2.0 * std::sin(half) * 4;
  const double mean_square = 4 * (1 - 2.0 / 3 * std::sin(half) * std::sin(half));  // of y, linear along the chords
  EXPECT_NEAR(power[1] / power[0], 2, 1e-12);
  EXPECT_NEAR(power[0], -area * (stiffness + damping) * mean_square, 1e-11 * area);
}

TEST(SurfaceSupport, ARingTiedToMovingTissueFollowsIt) {
  const WallMesh wall = plate({2, 1, 0.2}, {4, 2}, 1);
  const auto motion = [](double time) { return AffineDisplacement{Vec3(0.01 * time, 0.02 * time, 0)}; };
  WallSettings settings{.material = "neo_hookean", .material_values = {100.0, 0.3}, .density = 1e-3};
  WallModel model(
      wall, settings, wall.points, {},
      only(SurfaceSupport(wall.rings[0],
                          Configured<Support>(supports(), {"visco_elastic", {{"stiffness", 1e3}, {"damping", 0}}}),
                          motion)));
  SolidSolver solver(model);
  const Points load = Points::Zero(3, wall.interface_nodes);
  for (int step = 0; step < 200; ++step) {
    solver.begin_step(0.01 * step, 0.01);
    solver.evaluate(load);
    solver.accept();
  }
  const Points y = solver.displacement();
  for (const int node : nodes_of(wall.rings[0].triangles))
    EXPECT_LE((y.col(node) - motion(2.0).offset).norm(), 1e-3 * motion(2.0).offset.norm());
}

/// Pressed into springs, held by nothing else: the support carries the load exactly, at the displacement load/(k area).
TEST(SurfaceSupport, CarriesTheWholeLoadInEquilibrium) {
  const WallMesh wall = plate({3, 2, 0.5}, {3, 2}, 1);
  WallSettings settings{.material = "neo_hookean", .material_values = {50.0, 0.3}, .density = 1, .theta = 1};
  WallModel model(wall, settings, wall.points, {}, only(support_on(wall.outside[0])));
  SolidSolver solver(model);
  const Vec3 total(0.03, -0.02, 0.05);
  Points load = Points::Zero(3, wall.interface_nodes);
  for (const Triangle& t : wall.interface)  // consistent with a uniform traction
    for (int node : t) load.col(node) += total / (3.0 * static_cast<double>(wall.interface.size()));
  for (int step = 0; step < 100; ++step) {
    solver.begin_step(step, 1.0);
    solver.evaluate(load);
    solver.accept();
  }
  EXPECT_LE((solver.support_forces()[0] + total).norm(), 1e-8 * total.norm());
  Vec3 mean = Vec3::Zero();
  for (const Triangle& t : wall.outside[0].triangles)
    for (int node : t)
      mean += solver.displacement().col(node) / (3.0 * static_cast<double>(wall.outside[0].triangles.size()));
  EXPECT_LE((mean - total / (6 * stiffness)).norm(), 1e-8 * mean.norm());
}

}  // namespace
}  // namespace tether
