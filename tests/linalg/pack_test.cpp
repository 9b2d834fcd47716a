#include "common/linalg/pack.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace tether {
namespace {

Pack four(double a, double b, double c, double d) {
  Pack pack;
  for (const auto& [lane, x] : {std::pair{0, a}, {1, b}, {2, c}, {3, d}}) pack.set(lane, x);
  return pack;
}

TEST(Pack, ComputesEachLaneForItself) {
  const Pack a = four(1, 2, -3, 4), b = four(2, 0.5, 3, -8), c = (a + b) * a - 2.0 / b;
  for (int lane = 0; lane < Pack::width; ++lane) EXPECT_EQ(c[lane], (a[lane] + b[lane]) * a[lane] - 2 / b[lane]);
  EXPECT_EQ(sqrt(four(4, 9, 2, 0))[2], std::sqrt(2.0));
  EXPECT_EQ(larger(a, b)[3], 4);
  EXPECT_EQ(abs(b)[3], 8);
}

TEST(Pack, IsAScalarOfMatrices) {
  using Matrix = Eigen::Matrix<Pack, 3, 3>;
  Matrix m;
  Eigen::Matrix3d lanes[4];
  for (int lane = 0; lane < 4; ++lane) {
    lanes[lane].setRandom();
    for (int i = 0; i < 9; ++i) m(i).set(lane, lanes[lane](i));
  }
  const Matrix square = m.lazyProduct(m.transpose());
  for (int lane = 0; lane < 4; ++lane)
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(square(i)[lane], (lanes[lane] * lanes[lane].transpose())(i), 1e-15);
}

TEST(Pack, OneLaneAboveIsEnoughButNoneThatIsNoNumber) {
  EXPECT_TRUE(any_above(four(0, 0, 2, 0), 1.0));
  EXPECT_FALSE(any_above(four(0, 0, 1, 0), 1.0));
  EXPECT_FALSE(any_above(four(0, std::numeric_limits<double>::quiet_NaN(), 0, 0), 1.0));
}

TEST(Pack, CubeRootsAreRightToRounding) {
  for (double x = 1e-12; x < 1e12; x *= 1.37) {
    const Pack root = inverse_cube_root(four(x, 2 * x, x * x, 1 / x));
    EXPECT_NEAR(root[0] * std::cbrt(x), 1, 1e-15) << x;
    EXPECT_NEAR(root[2] * std::cbrt(x * x), 1, 1e-15) << x;
  }
  EXPECT_DOUBLE_EQ(inverse_cube_root(Pack(1.0))[0], 1);
  EXPECT_DOUBLE_EQ(inverse_cube_root(8.0), 0.5);
}

}  // namespace
}  // namespace tether
