#include "vessel/growth/outer_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "common/base/error.hpp"
#include "common/mesh/mesh.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"
#include "tests/vessel/anatomies/bifurcation.hpp"
#include "vessel/growth/crossings.hpp"
#include "vessel/growth/minimise.hpp"
#include "vessel/growth/prism_shape.hpp"
#include "vessel/growth/thickness.hpp"

namespace tether {
namespace growth_test {

GrowthBase base_of(const Points& points, const std::vector<Triangle>& triangles) {
  GrowthBase base{points, triangles, nodal_normals(points, triangles), Points::Zero(3, points.cols()), 2};
  for (const std::vector<int>& rim : rims(triangles)) {
    const Vec3 normal = plane_of_loop(points(Eigen::all, rim)).normal;
    for (const int node : rim) {
      base.planes.col(node) = normal;
      base.directions.col(node) -= normal * normal.dot(base.directions.col(node));
      base.directions.col(node).normalize();
    }
  }
  return base;
}

/// The smallest det T of all prisms, whose asked height is `heights`.
double worst_of(const GrowthBase& base, const Points& top, const VectorXd& heights) {
  double worst = 1e9;
  for (const Triangle& t : base.triangles)
    worst = std::min(worst, PrismShape(base.points(Eigen::all, t), heights(t)).worst(top(Eigen::all, t)));
  return worst;
}

TEST(Growth, StandsStraightWhereItHasRoom) {
  const TubeSurface tube = tube_surface(1, 4, 16, 12);
  const GrowthBase base = base_of(tube.points, tube.triangles);
  const OuterSurface outer = grow_outer_surface(base, VectorXd::Constant(tube.points.cols(), 0.2));
  EXPECT_LT((outer.points - base.points - 0.2 * base.directions).norm(), 1e-12);
  EXPECT_EQ(outer.aim, outer.asked);
  EXPECT_NEAR(outer.thickness.minCoeff(), 0.2, 1e-4);
  EXPECT_EQ(std::count(outer.moved.begin(), outer.moved.end(), 1), 0);
}

TEST(Growth, FillsASharpCrotchAtEveryEdgeLength) {
  for (const double edge : {0.4, 0.2, 0.12}) {
    const Bifurcation vessel = bifurcation(edge);
    const GrowthBase base = base_of(vessel.points, vessel.triangles);
    const TreeThickness thickness{{0.2, {}}, {{"branch", {0.1, {}}}}, {}};
    const VectorXd asked = thickness_at(base.points, thickness, Anatomy(vessel.tree));
    const Points straight = base.points + base.directions * asked.asDiagonal();
    const OuterSurface outer = grow_outer_surface(base, asked);
    EXPECT_GT(worst_of(base, outer.points, outer.aim), 0.1) << edge;
    if (edge < 0.4) {  // straight up it would fold
      EXPECT_LT(worst_of(base, straight, asked), 0) << edge;
    }
    EXPECT_TRUE(crossing_triangles(outer.points, base.triangles).empty()) << edge;
    EXPECT_EQ(outer.aim, asked) << edge;  // nothing had to be given up
    EXPECT_GT(outer.thickness.cwiseQuotient(asked).minCoeff(), 0.8) << edge;
    EXPECT_GT(outer.thickness.cwiseQuotient(asked).mean(), 0.99) << edge;
  }
}

TEST(Growth, AimsAtLessBetweenTwoTubesAndRefusesWhereThereIsNoRoom) {
  const auto grow = [](double gap) {
    const TubeSurface two = together(tube_surface(1, 4, 16, 12), tube_surface(1, 4, 16, 12, {2 + gap, 0, 0}));
    return grow_outer_surface(base_of(two.points, two.triangles), VectorXd::Constant(two.points.cols(), 0.2));
  };
  const OuterSurface outer = grow(0.3);
  EXPECT_LT(outer.thickness.minCoeff(), 0.16);
  EXPECT_GE(outer.aim.minCoeff(), least_share * 0.2);
  EXPECT_NEAR(outer.thickness.maxCoeff(), 0.2, 1e-3);
  try {
    grow(0.05);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("meets itself near ("), std::string::npos) << error.what();
  }
}

TEST(Growth, ThicknessGoesSmoothlyFromTrunkToBranch) {
  const Bifurcation vessel = bifurcation(0.4);
  const Anatomy anatomy(vessel.tree);
  const auto at = [&](const TreeThickness& thickness, const Vec3& x) { return thickness_at(x, thickness, anatomy)[0]; };
  const TreeThickness by_length{{0.2, {}}, {{"branch", {0.1, {}}}}, 0.6};
  EXPECT_EQ(at(by_length, {-1.2, 0, 3}), 0.2);
  EXPECT_EQ(at(by_length, {2.4, 0.4, 3}), 0.1);
  double before = at(by_length, {1.2, 0, 3.4});
  EXPECT_NEAR(before, 0.15, 1e-6);  // on the junction
  for (double x = 1.25; x < 2; x += 0.05) {
    const double here = at(by_length, {x, 0, 3.4});
    EXPECT_LE(here, before + 1e-12) << x;
    EXPECT_GT(here, before - 0.03) << x;
    before = here;
  }
  const TreeThickness by_radius{{{}, 0.15}, {}, {}};
  EXPECT_NEAR(at(by_radius, {-1.2, 0, 1}), 0.15 * 1.2, 1e-9);
  EXPECT_NEAR(at(by_radius, {2.6, 0.4, 3}), 0.15 * 0.4, 1e-9);
  EXPECT_THROW(at({{0.2, {}}, {{"carotid", {0.1, {}}}}, {}}, {0, 0, 0}), InputError);
}

TEST(Growth, EnergyOfAPrismIsLeastForTheAskedOne) {
  Mat3 base;
  base << 0, 1, 0.2, 0, 0.1, 0.9, 0, 0, 0.1;
  const Vec3 normal = (base.col(1) - base.col(0)).cross(base.col(2) - base.col(0)).normalized();
  const PrismShape shape(base, Vec3::Constant(0.3));
  const Mat3 right = base.colwise() + 0.3 * normal;
  Mat3 slope = Mat3::Zero();
  EXPECT_NEAR(shape.energy(right, 1e-9, slope), 1, 1e-9);
  EXPECT_LT(slope.norm(), 1e-7);
  EXPECT_NEAR(shape.worst(right), 1, 1e-12);
  for (const double size : {0.1, 1.0}) {  // the larger one folds it
    const Mat3 top = right + size * (Mat3() << 0.1, -0.5, 0.3, 0.2, 0.1, -0.6, -0.9, 0.2, 0.1).finished();
    slope.setZero();
    shape.energy(top, 0.05, slope);
    for (Eigen::Index i = 0; i < 9; ++i) {
      Mat3 more = top, fewer = top, unused = Mat3::Zero();
      more(i) += 1e-6, fewer(i) -= 1e-6;
      const double difference = (shape.energy(more, 0.05, unused) - shape.energy(fewer, 0.05, unused)) / 2e-6;
      EXPECT_NEAR(slope(i), difference, 1e-5 * (1 + std::abs(difference))) << size << " " << i;
    }
  }
}

TEST(Growth, MinimiserGoesThroughRosenbrocksValley) {
  const auto valley = [](const VectorXd& x, VectorXd& gradient) {
    const double a = 1 - x[0], b = x[1] - x[0] * x[0];
    gradient = Eigen::Vector2d(-2 * a - 400 * x[0] * b, 200 * b);
    return a * a + 100 * b * b;
  };
  const Minimum found = minimise(valley, Eigen::Vector2d(-1.2, 1), 200);
  EXPECT_LT((found.x - Eigen::Vector2d(1, 1)).norm(), 1e-4);
}

TEST(Growth, CrossingTrianglesAreFound) {
  const TubeSurface apart = together(tube_surface(1, 4, 12, 8), tube_surface(1, 4, 12, 8, {2.3, 0, 0}));
  EXPECT_TRUE(crossing_triangles(apart.points, apart.triangles).empty());
  const TubeSurface through = together(tube_surface(1, 4, 12, 8), tube_surface(1, 4, 12, 8, {1.9, 0, 0}));
  EXPECT_GT(crossing_triangles(through.points, through.triangles).size(), 20u);
}

}  // namespace growth_test
}  // namespace tether
