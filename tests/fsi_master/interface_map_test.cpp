#include "fsi_master/interface_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// A tube along z, radius 2, height 6.
InterfaceSurface tube(int around, int along) {
  InterfaceSurface tube{Points(3, around * (along + 1)), {}};
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      tube.points.col(k * around + i) << 2 * std::cos(angle), 2 * std::sin(angle), 6.0 * k / along;
    }
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const int a = k * around + i, b = k * around + (i + 1) % around;
      tube.triangles.push_back({a, b, b + around});
      tube.triangles.push_back({a, b + around, a + around});
    }
  return tube;
}

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
  const InterfaceMap map = InterfaceMap::match(fluid, solid, 1e-6);
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
    InterfaceMap::match(fluid, solid, 1e-6);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "unmatched interface: 2 of 72 fluid nodes have no wall node within 1e-06, the farthest is 0.3 away, at "
        "(1, -1.73205, 6.3)");
  }
  EXPECT_THROW(InterfaceMap::match(tube(6, 5), solid, 1e-6),
               InputError);  // each fluid node has its partner, not each wall node
}

TEST(InterfaceMap, NearestTriangleKeepsForceAndWork) {
  const InterfaceSurface solid = tube(16, 8), fluid = tube(24, 11);
  const InterfaceMap map = InterfaceMap::nearest_triangle(fluid, solid, 0.1);
  const VectorXd motion = VectorXd::Random(solid.points.size());
  const VectorXd load = VectorXd::Random(fluid.points.size());
  const std::vector<double> there = map.to_fluid(motion), forces(load.begin(), load.end());
  const VectorXd back = map.to_solid(forces);
  EXPECT_NEAR(Eigen::Map<const VectorXd>(there.data(), load.size()).dot(load), motion.dot(back), 1e-12);
  const Vec3 total = Eigen::Map<const Points>(load.data(), 3, fluid.points.cols()).rowwise().sum();
  const Vec3 received = Eigen::Map<const Points>(back.data(), 3, solid.points.cols()).rowwise().sum();
  EXPECT_LT((total - received).norm(), 1e-12);
}

TEST(InterfaceMap, NearestTriangleReproducesLinearMotionsOfItsOwnSurface) {
  const InterfaceSurface solid = tube(16, 8);
  const InterfaceMap map = InterfaceMap::nearest_triangle(solid, solid, 1e-6);
  const std::vector<double> there = map.to_fluid(flat(solid.points));
  EXPECT_LT((Eigen::Map<const VectorXd>(there.data(), solid.points.size()) - flat(solid.points)).norm(), 1e-12);
}

TEST(InterfaceMap, NearestTriangleRefusesASurfaceElsewhere) {
  const InterfaceSurface solid = tube(16, 8);
  InterfaceSurface fluid = solid;
  fluid.points.row(2).array() += 1.0;
  EXPECT_THROW(InterfaceMap::nearest_triangle(fluid, solid, 0.5), InputError);
}

}  // namespace
}  // namespace tether
