#include "observation_manager/measurements/signed_surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "tests/observation_manager/shapes.hpp"
#include "tests/solid/report.hpp"

namespace tether::testing {
namespace {

Points random_points(int count, double reach, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> coordinate(-reach, reach);
  Points points(3, count);
  for (double& x : points.reshaped()) x = coordinate(random);
  return points;
}

/// Positive outside.
double distance_to_cube(const Vec3& x) {
  const Vec3 beyond = x.cwiseAbs() - Vec3::Ones();
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

TEST(SignedSurface, OfACubeIsExactAtFacesEdgesAndVertices) {
  for (const int n : {1, 4}) {
    const SignedSurface surface(cube(n));
    const Points x = random_points(3000, 2, 1);
    const std::vector<Closest> found = surface.closest(x);
    std::array<int, 3> seen{};
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Closest& c = found[static_cast<std::size_t>(i)];
      EXPECT_NEAR(c.distance, -distance_to_cube(x.col(i)), 1e-14);
      EXPECT_LT((c.point - x.col(i) - c.distance * c.normal).norm(), 1e-14);
      EXPECT_FALSE(c.on_rim);
      ++seen[static_cast<std::size_t>(c.feature)];
    }
    for (const int count : seen) EXPECT_GT(count, 100) << n;
  }
}

TEST(SignedSurface, KnowsWhichFeatureOfACubeIsClosest) {
  const SignedSurface surface(cube(1));
  EXPECT_EQ(surface.closest(Vec3(1.5, 0.3, 0.1)).feature, Feature::face);
  EXPECT_EQ(surface.closest(Vec3(1.5, 1.5, 0.1)).feature, Feature::edge);
  EXPECT_EQ(surface.closest(Vec3(2, 2, 2)).feature, Feature::vertex);
  EXPECT_EQ(surface.closest(Vec3(2, 2, 2)).point, Vec3::Ones());
  const Closest on_it = surface.closest(Vec3(1, 0.3, 0.1));
  EXPECT_NEAR(on_it.distance, 0, 1e-15);
  EXPECT_EQ(on_it.normal, Vec3::UnitX());
}

/// Largest error of the distance to a shape that the surface approximates.
template <class Exact>
double largest_error(const SignedSurface& surface, const Points& x, Exact exact) {
  const std::vector<Closest> found = surface.closest(x);
  double largest = 0;
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    largest = std::max(largest, std::abs(found[static_cast<std::size_t>(i)].distance + exact(x.col(i))));
  return largest;
}

TEST(SignedSurface, OfASphereConvergesWithSecondOrder) {
  const Points x = random_points(2000, 1.5, 2);
  const auto exact = [](const Vec3& p) { return p.norm() - 1; };
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) errors.push_back(largest_error(SignedSurface(sphere(n)), x, exact));
  report("distance to a unit sphere, largest error, triangles on a quarter of its girth", std::array{8, 16, 32},
         errors);
  EXPECT_LT(errors[1], 4e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.15);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.15);
}

TEST(SignedSurface, OfATorusConvergesWithSecondOrder) {
  const Points x = random_points(2000, 2.6, 3);
  const auto exact = [](const Vec3& p) { return std::hypot(p.head<2>().norm() - 1.7, p[2]) - 0.6; };
  std::vector<double> errors;
  for (const int n : {24, 48, 96}) errors.push_back(largest_error(SignedSurface(torus(1.7, 0.6, 2 * n, n)), x, exact));
  report("distance to a torus (radii 1.7, 0.6), largest error, triangles around its tube", std::array{24, 48, 96},
         errors);
  EXPECT_LT(errors[1], 3e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.15);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.15);
}

/// To the plane if x stands above the triangle, else to the nearest of its sides.
double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto on_line = [&](const Vec3& p, const Vec3& q) {
    const double t = std::clamp((x - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
    return (p + t * (q - p) - x).norm();
  };
  const Vec3 normal = (b - a).cross(c - a);
  const auto left_of = [&](const Vec3& p, const Vec3& q) { return normal.dot((q - p).cross(x - p)) >= 0; };
  if (left_of(a, b) && left_of(b, c) && left_of(c, a)) return std::abs(normal.normalized().dot(x - a));
  return std::min({on_line(a, b), on_line(b, c), on_line(c, a)});
}

/// Solid angle of a closed surface over 4 pi: 1 inside, 0 outside (van Oosterom and Strackee 1983).
double winding_number(const TriangleSurface& surface, const Vec3& x) {
  double sum = 0;
  for (const Triangle& t : surface.triangles) {
    const Vec3 a = surface.points.col(t[0]) - x, b = surface.points.col(t[1]) - x, c = surface.points.col(t[2]) - x;
    sum += 2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                 b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return sum / (4 * std::numbers::pi);
}

TEST(SignedSurface, OfACrumpledSurfaceAgreesWithBruteForceAndTheWindingNumber) {
  TriangleSurface surface = sphere(6);
  surface.points += 0.06 * random_points(static_cast<int>(surface.points.cols()), 1, 4);  // sharp ridges and dents
  const Points x = random_points(2000, 1.3, 5);
  const std::vector<Closest> found = SignedSurface(surface).closest(x);
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    double nearest = 1e9;
    for (const Triangle& t : surface.triangles)
      nearest = std::min(nearest, distance_to_triangle(x.col(i), surface.points.col(t[0]), surface.points.col(t[1]),
                                                       surface.points.col(t[2])));
    const bool inside = winding_number(surface, x.col(i)) > 0.5;
    EXPECT_NEAR(found[static_cast<std::size_t>(i)].distance, inside ? nearest : -nearest, 1e-13)
        << x.col(i).transpose();
  }
}

TEST(SignedSurface, FlagsPointsBesideItsRim) {
  const SignedSurface surface(tube(64, 20, 4, [](double) { return 1.0; }));
  EXPECT_FALSE(surface.closest(Vec3(1.2, 0, 2)).on_rim);
  EXPECT_FALSE(surface.closest(Vec3(0, 0.8, 0.05)).on_rim);
  EXPECT_TRUE(surface.closest(Vec3(0, 0.8, -0.05)).on_rim);
  EXPECT_TRUE(surface.closest(Vec3(1.2, 0, 4.5)).on_rim);
  EXPECT_LT(surface.closest(Vec3(1.2, 0, 2)).distance, 0);
  EXPECT_GT(surface.closest(Vec3(0.8, 0, 2)).distance, 0);
}

TEST(SignedSurface, GivesTheSameOneByOne) {
  const SignedSurface surface(torus(1.7, 0.6, 40, 20));
  const Points x = random_points(200, 2.5, 6);
  const std::vector<Closest> found = surface.closest(x);
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    EXPECT_NEAR(surface.closest(Vec3(x.col(i))).distance, found[static_cast<std::size_t>(i)].distance, 1e-15);
}

void expect_the_same(const std::vector<Closest>& one, const std::vector<Closest>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].triangle, other[i].triangle) << i;
    EXPECT_EQ(one[i].distance, other[i].distance) << i;
    EXPECT_EQ(one[i].point, other[i].point) << i;
    EXPECT_EQ(one[i].normal, other[i].normal) << i;
  }
}

/// A wall that moves asks again and again. What is known from before is exact, bit for bit: a run that goes on from a
/// checkpoint knows nothing and must find the same. On a cube and its edges several triangles are as close.
TEST(SignedSurface, WhatIsKnownFromBeforeChangesNothing) {
  TriangleSurface crumpled = sphere(6);
  crumpled.points += 0.06 * random_points(static_cast<int>(crumpled.points.cols()), 1, 4);
  for (const TriangleSurface& shape : {cube(1), cube(4), torus(1.7, 0.6, 40, 20), crumpled}) {
    const SignedSurface surface(shape);
    std::vector<Neighbourhood> known;
    Points x = random_points(300, 1.5, 7);
    for (unsigned step = 0; step < 60; ++step) {
      expect_the_same(surface.closest(x, known), surface.closest(x));
      x += random_points(300, step < 50 ? 0.01 : 1, 8 + step);  // little steps, and some that lead far away
    }
  }
}

TEST(SignedSurface, KnowsNothingOfOtherPoints) {
  const SignedSurface surface(torus(1.7, 0.6, 40, 20));
  std::vector<Neighbourhood> known;
  surface.closest(random_points(40, 2, 1), known);
  const Points x = random_points(90, 2, 2);
  expect_the_same(surface.closest(x, known), surface.closest(x));
}

/// Steps within the reach ask no tree: it stays where it was made, and grows with the triangles.
TEST(SignedSurface, ReachesAsFarAsItsTriangles) {
  std::vector<double> reaches;
  for (const int n : {20, 40}) {
    const SignedSurface surface(torus(1.7, 0.6, 2 * n, n));
    std::vector<Neighbourhood> known;
    const Points x{{2.25}, {0}, {0}}, moved{{2.25}, {0.001}, {0.001}};
    surface.closest(x, known);
    surface.closest(moved, known);
    EXPECT_EQ(known.front().centre, x.col(0));
    reaches.push_back(known.front().reach);
  }
  EXPECT_NEAR(reaches[0] / reaches[1], 2, 0.5);
}

}  // namespace
}  // namespace tether::testing
