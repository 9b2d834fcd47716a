#include "vessel/anatomy/geodesic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vessel/anatomies/bifurcation.hpp"

namespace tether {
namespace geodesic_test {

/// The mean error at the nodes that are truly less than a length away.
template <class Truth>
double mean_error(const TubeSurface& surface, const Points& curve, double within, Truth truth) {
  const TriangleLocator locator(surface.points, surface.triangles);
  const GeodesicDistance distance(locator, curve, within);
  double sum = 0;
  int count = 0;
  std::vector<char> seen(static_cast<std::size_t>(surface.points.cols()), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const int node = surface.triangles[t][corner];
      const double right = truth(Vec3(surface.points.col(node)));
      if (seen[static_cast<std::size_t>(node)]++ || right > 0.9 * within) continue;
      sum += std::abs(distance.at(static_cast<int>(t), Vec3::Unit(static_cast<Eigen::Index>(corner))) - right);
      ++count;
    }
  return sum / count;
}

TEST(Geodesic, FromAPointOfACylinder) {
  const Vec3 from = Vec3(std::cos(0.1), std::sin(0.1), 2.04);
  const auto truth = [&](const Vec3& x) {
    return std::hypot(std::remainder(std::atan2(x[1], x[0]) - 0.1, 2 * std::numbers::pi), x[2] - from[2]);
  };
  std::vector<double> errors;
  for (const int n : {12, 24, 48}) errors.push_back(mean_error(tube_surface(1, 4, n, n * 2 / 3), from, 1.5, truth));
  EXPECT_LT(errors[2], 1.5e-3);
  for (const std::size_t i : {1u, 2u})
    EXPECT_GT(std::log2(errors[i - 1] / errors[i]), 1.7) << errors[i - 1] << " " << errors[i];
}

TEST(Geodesic, FromTheOuterEquatorOfATorus) {
  Points equator(3, 401);
  for (Eigen::Index i = 0; i < equator.cols(); ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / 400;
    equator.col(i) = 4 * Vec3(std::cos(turn), std::sin(turn), 0);
  }
  const auto truth = [](const Vec3& x) { return std::abs(std::atan2(x[2], std::hypot(x[0], x[1]) - 3)); };
  std::vector<double> errors;
  for (const int n : {10, 20, 40}) errors.push_back(mean_error(torus_surface(3, 1, n, 3 * n), equator, 1.4, truth));
  EXPECT_LT(errors[2], 2e-3);
  for (const std::size_t i : {1u, 2u})
    EXPECT_GT(std::log2(errors[i - 1] / errors[i]), 1.7) << errors[i - 1] << " " << errors[i];
}

TEST(Geodesic, OfAnotherPartIsNoNearerThanAskedFor) {
  const TubeSurface two = together(tube_surface(1, 2, 12, 6), tube_surface(1, 2, 12, 6, {2.2, 0, 0}));
  const TriangleLocator locator(two.points, two.triangles);
  const GeodesicDistance distance(locator, Vec3(1, 0, 1), 1);
  EXPECT_LT(distance.at(0, Vec3::UnitX()), 1.2);
  EXPECT_GE(distance.at(static_cast<int>(two.triangles.size()) - 1, Vec3::UnitX()), 1);
}

}  // namespace geodesic_test
}  // namespace tether
