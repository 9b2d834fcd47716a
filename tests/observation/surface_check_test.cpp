// Bad surfaces: each ends in one message, or in a stated and counted exclusion.
#include "common/observation/surface_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/base/error.hpp"
#include "tests/observation/lumens.hpp"

namespace tether::testing {
namespace {

TriangleSurface joined(TriangleSurface a, const TriangleSurface& b) {
  const int shift = static_cast<int>(a.points.cols());
  Points both(3, a.points.cols() + b.points.cols());
  both << a.points, b.points;
  a.points = both;
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

TriangleSurface moved(TriangleSurface surface, const Vec3& by) {
  surface.points.colwise() += by;
  return surface;
}

std::string message_of(const TriangleSurface& surface) {
  try {
    checked_surface("a.stl", surface);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

using Notes = std::vector<std::string>;

TEST(SurfaceCheck, LeavesAGoodSurfaceAlone) {
  const CheckedSurface checked = checked_surface("a.stl", torus(1.7, 0.6, 24, 12));
  EXPECT_EQ(checked.notes, Notes{});
  EXPECT_TRUE(checked.flawed.empty());
  EXPECT_EQ(checked.surface.triangles.size(), 2U * 24 * 12);
}

/// Triangles of one plane that share a node: rounding must not make them pass through each other.
TEST(SurfaceCheck, LeavesAStraightObliqueTubeAlone) {
  TriangleSurface surface = tube(28, 20, 4, [](double) { return 0.8; });
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).matrix();
  surface.points = (turn * surface.points).colwise() + Vec3(-0.4, 6, -9);
  for (const bool rounded : {false, true}) {
    if (rounded) surface.points = surface.points.cast<float>().cast<double>().eval();
    EXPECT_EQ(message_of(surface), "") << rounded;
    EXPECT_TRUE(checked_surface("a.stl", surface).flawed.empty()) << rounded;
  }
}

TEST(SurfaceCheck, RefusesASurfaceWithoutTriangles) {
  EXPECT_EQ(message_of({Points::Zero(3, 4), {}}), "a.stl: holds no triangles: must be the surface of the lumen");
}

TEST(SurfaceCheck, RefusesAnEdgeOfThreeTriangles) {
  TriangleSurface surface = cube(1);
  surface.triangles.push_back(surface.triangles.front());
  EXPECT_EQ(message_of(surface),
            "a.stl: 3 edges have more than two triangles, the first near (-1, 0, 0): not the surface of a lumen");
}

TEST(SurfaceCheck, RefusesNormalsThatDisagree) {
  TriangleSurface surface = sphere(4);
  std::swap(surface.triangles[5][0], surface.triangles[5][1]);
  EXPECT_NE(message_of(surface).find("the normals of neighbouring triangles disagree at 3 edges"), std::string::npos)
      << message_of(surface);
}

TEST(SurfaceCheck, TurnsASurfaceThatLooksInward) {
  for (TriangleSurface surface : {sphere(4), tube(16, 8, 3, [](double) { return 1.0; })}) {
    for (Triangle& t : surface.triangles) std::swap(t[0], t[1]);
    const CheckedSurface checked = checked_surface("a.stl", surface);
    EXPECT_EQ(checked.notes.front(), "its normals looked inward; turned");
    EXPECT_GT(SignedSurface(checked.surface).closest(Vec3(0.1, 0, 0.5)).distance, 0);
  }
}

TEST(SurfaceCheck, CountsTrianglesWithoutArea) {
  TriangleSurface surface = sphere(4);
  surface.triangles.push_back({0, 1, 1});
  surface.triangles.push_back({2, 2, 2});
  EXPECT_EQ(checked_surface("a.stl", surface).notes, Notes{"2 triangles without area are left out"});
}

TEST(SurfaceCheck, JoinsEqualPoints) {
  const TriangleSurface given = sphere(4);
  TriangleSurface loose;  // as STL: three points a triangle
  loose.points.resize(3, static_cast<Eigen::Index>(3 * given.triangles.size()));
  for (std::size_t t = 0; t < given.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<int>(3 * t) + i;
      loose.points.col(at) = given.points.col(given.triangles[t][static_cast<std::size_t>(i)]);
      if (i == 0) loose.triangles.push_back({at, at + 1, at + 2});
    }
  const CheckedSurface checked = checked_surface("a.stl", loose);
  EXPECT_EQ(checked.notes, Notes{});
  EXPECT_EQ(checked.surface.points.cols(), given.points.cols());
}

TEST(SurfaceCheck, LeavesOutLoosePieces) {
  const TriangleSurface crumb = moved(scaled(sphere(1), 0.05), Vec3(1.5, 0, 0));
  const CheckedSurface checked = checked_surface("a.stl", joined(sphere(6), crumb));
  EXPECT_EQ(checked.notes, Notes{"1 loose pieces with 12 triangles are left out"});
  EXPECT_EQ(checked_surface("a.stl", joined(sphere(6), moved(sphere(6), Vec3(3, 0, 0)))).notes,
            Notes{"consists of 2 separate pieces"});
}

TEST(SurfaceCheck, StatesHoles) {
  EXPECT_EQ(checked_surface("a.stl", tube(64, 8, 3, [](double) { return 1.0; })).notes,
            Notes{"2 open rims, 6.28, 6.28 long; beside them nothing is observed"});
}

TEST(SurfaceCheck, ObservesNothingWhereFewTrianglesCross) {
  TriangleSurface surface = sphere(24);
  auto tip = surface.points.col(surface.triangles[100][0]);
  tip = -1.1 * tip + Vec3(0.01, 0.02, -0.015);  // a spike through the opposite side
  const CheckedSurface checked = checked_surface("a.stl", surface);
  ASSERT_EQ(checked.notes.size(), 1U);
  EXPECT_NE(checked.notes[0].find("triangles pass through each other"), std::string::npos) << checked.notes[0];
  EXPECT_GT(std::count(checked.flawed.begin(), checked.flawed.end(), true), 1);
}

TEST(SurfaceCheck, RefusesASurfaceThatCrossesItself) {
  const std::string message = message_of(joined(sphere(4), moved(sphere(5), Vec3(0.7, 0.1, 0.05))));
  EXPECT_NE(message.find("triangles pass through each other"), std::string::npos) << message;
  EXPECT_NE(message.find("more than a hundredth"), std::string::npos);
}

TEST(SurfaceCheck, RefusesDataElsewhereOrInAnotherUnit) {
  const LumenSurface model = lumen(tube(16, 8, 3, [](double) { return 1.0; }));
  const auto overlap = [&](const TriangleSurface& data) {
    try {
      check_overlap("a.stl", data, model, 0.5);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(overlap(tube(20, 9, 3, [](double) { return 1.1; })), "");
  EXPECT_EQ(
      overlap(moved(tube(16, 8, 3, [](double) { return 1.1; }), Vec3(20, 0, 0))),
      "a.stl: does not overlap the model: the nearest place is 17.9 away, at most 0.5 would do; the data reach from "
      "(18.9, -1.1, 0) to (21.1, 1.1, 3), the model from (-1, -1, 0) to (1, 1, 3)");
  EXPECT_NE(overlap(scaled(tube(16, 8, 3, [](double) { return 1.1; }), 10))
                .find("In another unit? Multiplied by 0.1 they would be about as large"),
            std::string::npos);
}

}  // namespace
}  // namespace tether::testing
