#include "common/mesh/triangle_locator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "common/mesh/surface.hpp"

namespace tether {
namespace triangle_locator_test {

/// Triangles here and there.
TriangleLocator scattered(int count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  Points points(3, 3 * count);
  for (double& x : points.reshaped()) x = anywhere(random);
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    for (int corner : {1, 2}) points.col(3 * i + corner) = points.col(3 * i) + 0.2 * points.col(3 * i + corner);
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return {points, triangles};
}

TEST(TriangleLocator, FindsWhatASearchOfAllFinds) {
  const TriangleLocator locator = scattered(200);
  for (int i = 0; i < 50; ++i) {
    const Vec3 x(std::sin(i), std::cos(2 * i), std::sin(3 * i));
    double least = 1e9;
    std::set<int> overlapping, found;
    for (int t = 0; t < 200; ++t) {
      const Mat3 corners = locator.points()(Eigen::all, locator.triangles()[static_cast<std::size_t>(t)]);
      const Vec3 weights = closest_in_triangle(x, corners.col(0), corners.col(1), corners.col(2));
      least = std::min(least, (corners * weights - x).norm());
      const Vec3 low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
      if (((low - x).array() <= 0.3).all() && ((x - high).array() <= 0.3).all()) overlapping.insert(t);
    }
    const auto nearest = locator.nearest(x);
    EXPECT_NEAR(nearest.distance, least, 1e-14);
    EXPECT_NEAR((nearest.place - x).norm(), least, 1e-14);
    locator.overlapping(x.array() - 0.3, x.array() + 0.3, [&](int t) { found.insert(t); });
    EXPECT_EQ(found, overlapping);
  }
}

TEST(TriangleLocator, OfNothingFindsNothing) {
  const TriangleLocator none(Points(3, 0), {});
  EXPECT_EQ(none.nearest(Vec3::Zero()).triangle, -1);
}

}  // namespace triangle_locator_test
}  // namespace tether
