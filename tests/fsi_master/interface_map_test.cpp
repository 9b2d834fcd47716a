#include "fsi_master/transfer/interface_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>

#include "common/base/error.hpp"
#include "fsi_master/transfer/interface_fit.hpp"
#include "tests/fsi_master/interface_tube.hpp"

namespace tether {
namespace {

VectorXd flat(const Points& points) {
  return Eigen::Map<const VectorXd>(points.data(), points.size());
}

TEST(InterfaceMap, MatchFindsThePermutation) {
  const InterfaceSurface solid = tube(12, 5);
  std::vector<int> order(solid.points.cols());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  InterfaceSurface fluid{Points(3, order.size()), {}};
  for (std::size_t a = 0; a < order.size(); ++a)
    fluid.points.col(static_cast<Eigen::Index>(a)) = solid.points.col(order[a]) + Vec3::Constant(1e-7);
  const InterfaceMap map = InterfaceMap::match(fluid, solid, 1e-6, UnitSystem::cgs());
  const VectorXd values = VectorXd::Random(solid.points.size());
  const std::vector<double> there = map.to_fluid(values);
  for (std::size_t a = 0; a < order.size(); ++a) EXPECT_EQ(there[3 * a], values(3 * order[a]));
  EXPECT_EQ(map.to_solid(there), values);
}

TEST(InterfaceMap, MatchSaysHowManyNodesAreAloneAndWhere) {
  const InterfaceSurface solid = tube(12, 5);
  InterfaceSurface fluid = solid;
  fluid.points(2, 7) -= 0.1;
  fluid.points(2, 70) += 0.3;
  try {
    InterfaceMap::match(fluid, solid, 1e-6, UnitSystem::cgs());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "unmatched interface: 2 of 72 fluid nodes have no wall node within 1e-05 mm, the farthest is 3 mm away, at "
        "(1, -1.73205, 6.3) cm");
  }
  EXPECT_THROW(InterfaceMap::match(tube(6, 5), solid, 1e-6, UnitSystem::cgs()),
               InputError);  // each fluid node has its partner, not each wall node
}

/// The same nodes, the quadrilaterals between them cut along the other diagonal.
InterfaceSurface cut_otherwise(InterfaceSurface surface) {
  for (std::size_t i = 0; i + 1 < surface.triangles.size(); i += 2) {
    const Triangle one = surface.triangles[i], other = surface.triangles[i + 1];
    EXPECT_EQ(one[0], other[0]);
    EXPECT_EQ(one[2], other[1]);
    surface.triangles[i] = {one[0], one[1], other[2]};
    surface.triangles[i + 1] = {one[1], one[2], other[2]};
  }
  return surface;
}

TEST(InterfaceMap, NodesThatMatchInOtherTrianglesDoNot) {
  const InterfaceSurface solid = tube(12, 5);
  InterfaceSurface turned = solid;
  for (Triangle& triangle : turned.triangles) std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  std::reverse(turned.triangles.begin(), turned.triangles.end());
  EXPECT_TRUE(InterfaceMap::matches(solid, solid, 1e-6));
  EXPECT_TRUE(InterfaceMap::matches(turned, solid, 1e-6));  // the same, written otherwise
  EXPECT_TRUE(InterfaceMap::matches({solid.points, {}}, solid, 1e-6));
  EXPECT_FALSE(InterfaceMap::matches(cut_otherwise(solid), solid, 1e-6));
  EXPECT_FALSE(InterfaceMap::matches(tube(6, 5), solid, 1e-6));
}

/// Both maps of surfaces that differ in their nodes, in their facets and by a gap.
std::vector<InterfaceMap> maps_of(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust = 0.3) {
  std::vector<InterfaceMap> maps;
  maps.push_back(InterfaceMap::nearest_triangle(fluid, solid, trust, UnitSystem::cgs()));
  maps.push_back(InterfaceMap::mortar(fluid, solid, trust, UnitSystem::cgs()));
  return maps;
}

TEST(InterfaceMap, SurfacesThatDifferKeepForceMomentAndWork) {
  const InterfaceSurface solid = tube(16, 8);
  InterfaceSurface fluid = tube(23, 11);
  fluid.points.topRows(2) *= 0.96;
  for (const InterfaceMap& map : maps_of(fluid, solid)) {
    const VectorXd motion = VectorXd::Random(solid.points.size()), load = VectorXd::Random(fluid.points.size());
    const InterfaceBalance lost = map.balance({load.begin(), load.end()}, motion);
    EXPECT_LT(lost.force, 1e-14);
    EXPECT_LT(lost.moment, 1e-14);
    EXPECT_LT(lost.work, 1e-14);
  }
}

TEST(InterfaceMap, ABalanceThatIsNotKeptIsSeen) {
  const Points points = tube(6, 2).points;
  const VectorXd force = VectorXd::Random(points.size()), motion = VectorXd::Random(points.size());
  VectorXd other = force;
  other(5) += 1e-3 * force.cwiseAbs().sum();
  const InterfaceBalance lost = balance({points, force, motion}, {points, other, motion});
  EXPECT_GT(lost.force, 1e-4);
  EXPECT_GT(lost.moment, 1e-4);
  EXPECT_GT(lost.work, 1e-5);
}

TEST(InterfaceMap, AFluidFollowsARigidWallRigidlyAcrossAGap) {
  const InterfaceSurface solid = tube(16, 8);
  InterfaceSurface fluid = tube(23, 11);
  fluid.points.topRows(2) *= 0.96;
  const Vec3 turn(0.3, -0.2, 0.5), shift(0.1, 0.7, -0.4);
  const auto rigid = [&](const Points& points) -> VectorXd {
    Points motion = points;
    for (auto column : motion.colwise()) column = turn.cross(Vec3(column)) + shift;
    return flat(motion);
  };
  for (const InterfaceMap& map : maps_of(fluid, solid)) {
    const std::vector<double> there = map.to_fluid(rigid(solid.points));
    EXPECT_LT((Eigen::Map<const VectorXd>(there.data(), fluid.points.size()) - rigid(fluid.points)).norm(), 1e-12);
  }
}

TEST(InterfaceMap, ItsOwnSurfaceIsFollowedExactlyUnderLinearMotions) {
  const InterfaceSurface solid = tube(16, 8);
  for (const InterfaceMap& map : maps_of(solid, solid)) {
    const std::vector<double> there = map.to_fluid(flat(solid.points));
    EXPECT_LT((Eigen::Map<const VectorXd>(there.data(), solid.points.size()) - flat(solid.points)).norm(), 1e-11);
  }
}

TEST(InterfaceMap, OfItsOwnSurfaceTheMortarIsTheIdentity) {
  const InterfaceSurface solid = tube(16, 8);
  const InterfaceMap map = InterfaceMap::mortar(solid, solid, 0.1, UnitSystem::cgs());
  const VectorXd motion = VectorXd::Random(solid.points.size());
  const std::vector<double> there = map.to_fluid(motion);
  EXPECT_LT((Eigen::Map<const VectorXd>(there.data(), motion.size()) - motion).norm(), 1e-11 * motion.norm());
}

TEST(InterfaceMap, ASurfaceElsewhereIsRefused) {
  const InterfaceSurface solid = tube(16, 8);
  InterfaceSurface fluid = solid;
  fluid.points.row(2).array() += 1.0;
  EXPECT_THROW(InterfaceMap::nearest_triangle(fluid, solid, 0.5, UnitSystem::cgs()), InputError);
  try {
    InterfaceMap::mortar(fluid, solid, 0.5, UnitSystem::mm_g_s());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(" mm is 1 mm away from the wall, more than 0.5 mm"), std::string::npos)
        << error.what();
  }
}

TEST(InterfaceMap, SurfacesWithoutTrianglesOrAreaAreRefused) {
  const InterfaceSurface good = tube(16, 8);
  InterfaceSurface bare = good, flat_triangle = good;
  bare.triangles.clear();
  flat_triangle.triangles[3] = {4, 4, 5};
  for (const InterfaceSurface& bad : {bare, flat_triangle}) {
    EXPECT_THROW(InterfaceMap::mortar(good, bad, 0.5, UnitSystem::cgs()), InputError);
    EXPECT_THROW(InterfaceMap::mortar(bad, good, 0.5, UnitSystem::cgs()), InputError);
    EXPECT_THROW(InterfaceMap::nearest_triangle(good, bad, 0.5, UnitSystem::cgs()), InputError);
  }
}

TEST(InterfaceFit, TellsGapsOverlapsAndBareWall) {
  const InterfaceSurface solid = tube(48, 12);
  InterfaceSurface fluid = tube(48, 12);
  fluid.points.topRows(2) *= 0.95;
  fluid.points.row(2) *= 0.5;  // half as long
  fluid.points.topRows(2).col(5) *= 2.1 / (0.95 * 2.0);
  const InterfaceFit fit = interface_fit(fluid, solid, 0.3);
  EXPECT_NEAR(fit.largest_gap, 0.1, 1e-3);
  EXPECT_NEAR(fit.largest_overlap, 0.1, 1e-3);
  EXPECT_NEAR(fit.rms_distance, 0.1, 1e-3);
  EXPECT_NEAR(fit.bare_area / fit.wall_area, 0.5, 0.05);
  EXPECT_EQ(fit.against_area, 0);
  for (Triangle& t : fluid.triangles) std::swap(t[1], t[2]);
  EXPECT_NEAR(interface_fit(fluid, solid, 0.3).against_area, fit.fluid_area, 1e-12);
}

}  // namespace
}  // namespace tether
