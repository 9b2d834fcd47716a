// Bad surfaces: each ends in one message, or in a stated and counted exclusion.
#include "observation_manager/measurements/surface_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/base/error.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "tests/observation_manager/lumens.hpp"

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

/// As STL has it: three points a triangle.
TriangleSurface loosened(const TriangleSurface& given) {
  TriangleSurface loose;
  loose.points.resize(3, static_cast<Eigen::Index>(3 * given.triangles.size()));
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    const auto at = static_cast<int>(3 * t);
    loose.points.middleCols(at, 3) = given.points(Eigen::all, given.triangles[t]);
    loose.triangles.push_back({at, at + 1, at + 2});
  }
  return loose;
}

std::string fault_of(const TriangleSurface& surface) {
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
    EXPECT_EQ(fault_of(surface), "") << rounded;
    EXPECT_TRUE(checked_surface("a.stl", surface).flawed.empty()) << rounded;
  }
}

TEST(SurfaceCheck, RefusesASurfaceWithoutTriangles) {
  EXPECT_EQ(fault_of({Points::Zero(3, 4), {}}), "a.stl: holds no triangles: must be the surface of the lumen");
}

TEST(SurfaceCheck, RefusesAnEdgeOfThreeTriangles) {
  TriangleSurface surface = cube(1);
  surface.triangles.push_back(surface.triangles.front());
  EXPECT_EQ(fault_of(surface),
            "a.stl: 3 edges have more than two triangles, the first near (-1, 0, 0): not the surface of a lumen");
}

TEST(SurfaceCheck, RefusesNormalsThatDisagree) {
  TriangleSurface surface = sphere(4);
  std::swap(surface.triangles[5][0], surface.triangles[5][1]);
  EXPECT_NE(fault_of(surface).find("the normals of neighbouring triangles disagree at 3 edges"), std::string::npos)
      << fault_of(surface);
}

TEST(SurfaceCheck, TurnsASurfaceThatLooksInward) {
  for (TriangleSurface surface : {sphere(4), tube(16, 8, 3, [](double) { return 1.0; })}) {
    for (Triangle& t : surface.triangles) std::swap(t[0], t[1]);
    const CheckedSurface checked = checked_surface("a.stl", surface);
    EXPECT_EQ(checked.notes.front(), "its normals looked inward; turned");
    EXPECT_GT(SignedSurface(checked.surface).closest(Vec3(0.1, 0, 0.5)).distance, 0);
  }
}

TEST(SurfaceCheck, TurnsThePiecesThatLookInward) {
  const TriangleSurface below = tube(16, 8, 3, [](double) { return 1.0; });
  TriangleSurface above = moved(below, Vec3(0, 0, 3.2));
  for (Triangle& t : above.triangles) std::swap(t[0], t[1]);
  const CheckedSurface checked = checked_surface("a.stl", joined(below, above));
  EXPECT_EQ(checked.notes.at(1), "the normals of 1 of its 2 pieces looked inward; turned");
  const SignedSurface surface(checked.surface);
  EXPECT_GT(surface.closest(Vec3(0.9, 0, 1.5)).distance, 0);
  EXPECT_GT(surface.closest(Vec3(0.9, 0, 4.7)).distance, 0);
}

TEST(SurfaceCheck, CountsTrianglesWithoutArea) {
  TriangleSurface surface = sphere(4);
  surface.triangles.push_back({0, 1, 1});
  surface.triangles.push_back({2, 2, 2});
  EXPECT_EQ(checked_surface("a.stl", surface).notes, Notes{"2 triangles without area are left out"});
}

TEST(SurfaceCheck, JoinsEqualPoints) {
  const TriangleSurface given = sphere(4);
  const TriangleSurface loose = loosened(given);
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
  EXPECT_EQ(
      checked_surface("a.stl", tube(64, 8, 3, [](double) { return 1.0; })).notes,
      Notes{"2 open rims, around them 6.28, 6.28 (in the case's unit of length); beside them nothing is observed"});
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
  const std::string message = fault_of(joined(sphere(4), moved(sphere(5), Vec3(0.7, 0.1, 0.05))));
  EXPECT_NE(message.find("triangles pass through each other"), std::string::npos) << message;
  EXPECT_NE(message.find("more than a hundredth"), std::string::npos);
}

TEST(SurfaceCheck, KeepsTheLargestPieceAlways) {
  TriangleSurface surface = sphere(6);
  for (int i = 1; i <= 3; ++i) surface = joined(surface, moved(scaled(sphere(1), 0.05), Vec3(1 + i, 0, 0)));
  EXPECT_EQ(checked_surface("a.stl", surface).surface.triangles.size(), 6U * 36 * 2);
  // As STL with corners that differ by rounding: each triangle on its own.
  TriangleSurface loose = loosened(sphere(4));
  for (Eigen::Index i = 0; i < loose.points.cols(); ++i) loose.points.col(i) *= 1 + 1e-9 * static_cast<double>(i);
  EXPECT_EQ(fault_of(loose),
            "a.stl: falls into 192 separate pieces, the largest with 1 % of the area: must be one surface. Are the "
            "corners of neighbouring triangles at slightly different points? Then merge them");
}

TEST(SurfaceCheck, LeavesOutAPointFarFromAllOthers) {
  TriangleSurface surface = sphere(8);
  surface.points.col(surface.triangles[100][0]) = Vec3(0, 1e200, 3);
  const CheckedSurface checked = checked_surface("a.stl", surface);
  ASSERT_EQ(checked.notes.size(), 2U);
  EXPECT_EQ(checked.notes[0],
            "1 points far from all others, the first at (0, 1e+200, 3), are left out with 6 triangles");
  EXPECT_EQ(checked.notes[1].substr(0, 12), "1 open rims,");
}

TEST(SurfaceCheck, NamesWhereHolesTouch) {
  TriangleSurface surface = sphere(8);  // two triangles that share one node only are taken out
  const int node = surface.triangles[40][0];
  std::vector<Triangle> around;
  std::erase_if(surface.triangles, [&](const Triangle& t) {
    const bool touches = std::find(t.begin(), t.end(), node) != t.end();
    const bool apart = std::none_of(around.begin(), around.end(), [&](const Triangle& other) {
      return std::count_if(t.begin(), t.end(),
                           [&](int n) { return std::find(other.begin(), other.end(), n) != other.end(); }) > 1;
    });
    if (!touches || !apart || around.size() == 2) return false;
    around.push_back(t);
    return true;
  });
  ASSERT_EQ(around.size(), 2U);
  EXPECT_NE(fault_of(surface).find("a.stl: its open edges fork at 1 points, the first at ("), std::string::npos)
      << fault_of(surface);
}

TEST(SurfaceCheck, SaysWhichShareOfTheLumenIsNear) {
  const LumenSurface model = lumen(tube(16, 8, 3, [](double) { return 1.0; }));
  const Placing good = placing_of(tube(20, 9, 3, [](double) { return 1.1; }), model, 0.5);
  EXPECT_EQ(good.near, 1);
  EXPECT_EQ(good.opposed, 0);
  EXPECT_GT(good.faced, 0.7);  // all but its ends
  EXPECT_EQ(placing_of(moved(tube(16, 8, 3, [](double) { return 1.1; }), Vec3(20, 0, 0)), model, 0.5).near, 0);
  const double touching = placing_of(moved(tube(64, 8, 3, [](double) { return 1.0; }), Vec3(2, 0, 0)), model, 1).near;
  EXPECT_LT(touching, 0.3) << "the vessel beside it looks the other way where it is near";
}

TEST(SurfaceCheck, KnowsTheWallFromTheLumen) {
  const LumenSurface model = lumen(tube(16, 8, 3, [](double) { return 1.0; }));
  TriangleSurface inner = tube(16, 8, 3, [](double) { return 1.1; });
  for (Triangle& t : inner.triangles) std::swap(t[0], t[1]);  // as the inner side of a solid wall looks
  const Placing found = placing_of(joined(inner, tube(16, 8, 3, [](double) { return 1.3; })), model, 0.5);
  EXPECT_GT(found.opposed, 0.9);
  EXPECT_EQ(found.near, 0);
}

TEST(SurfaceCheck, TakesNoVesselThatCrossesForTheSame) {
  const LumenSurface model = lumen(tube(16, 16, 8, [](double) { return 1.0; }));
  TriangleSurface across = moved(tube(16, 16, 8, [](double) { return 1.0; }), Vec3(0, 0, -4));
  across.points.row(0).swap(across.points.row(2));
  for (Triangle& t : across.triangles) std::swap(t[0], t[1]);
  const Placing found = placing_of(moved(across, Vec3(0, 0, 4)), model, 1);
  EXPECT_LT(found.near, 0.5);
}

TEST(SurfaceCheck, GuessesTheUnit) {
  EXPECT_EQ(power_of_ten(10.5), 1);
  EXPECT_EQ(power_of_ten(4), 0);
  EXPECT_EQ(power_of_ten(1.5e-3), -3);
  EXPECT_EQ(power_of_ten(0), 0);
  EXPECT_EQ(guessed_unit(1, "cm"), "about 10 times larger than the model: is its unit mm, not cm?");
  EXPECT_EQ(guessed_unit(-3, "mm"), "about 1000 times smaller than the model: is its unit m, not mm?");
  EXPECT_EQ(guessed_unit(2, "mm"), "about 100 times larger than the model: in another unit?");
}

/// A tube of radius r from z = from to z = to, its flat ends of a fan and two rings.
TriangleSurface capped(double r, double from, double to) {
  constexpr int around = 32, along = 16, rings = 3;
  TriangleSurface surface = grid({around, along + 2 * (rings - 1), true, false}, [&](int i, int j) {
    const int in = std::max(0, std::max(rings - 1 - j, j - (along + rings - 1)));  // rings away from the wall
    const double share = std::clamp((j - (rings - 1.0)) / along, 0.0, 1.0), radius = r * (rings - in) / rings;
    const double angle = 2 * std::numbers::pi * i / around;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), from + share * (to - from));
  });
  const int columns = along + 2 * (rings - 1) + 1, first = static_cast<int>(surface.points.cols());
  surface.points.conservativeResize(3, first + 2);
  surface.points.col(first) = Vec3(0, 0, from), surface.points.col(first + 1) = Vec3(0, 0, to);
  for (int i = 0; i < around; ++i) {
    const int a = i * columns, b = (i + 1) % around * columns;
    surface.triangles.push_back({b, a, first});
    surface.triangles.push_back({a + columns - 1, b + columns - 1, first + 1});
  }
  return surface;
}

TEST(OpenEnds, FlatEndsOfASegmentationAreNoWall) {
  const LumenSurface model = lumen(tube(24, 10, 4, [](double) { return 1.0; }));
  const std::vector<Opening> openings = openings_of(model);
  ASSERT_EQ(openings.size(), 2U);
  for (const Opening& opening : openings) {
    EXPECT_NEAR(opening.radius, 1, 0.01);
    EXPECT_NEAR(opening.axis[2], opening.centre[2] > 2 ? 1 : -1, 1e-12);
  }
  // As long as the model, longer, shorter; wider than it by a fifth.
  for (const double more : {0.0, 0.4, -0.3}) {
    CheckedSurface checked = checked_surface("a.stl", capped(1.2, -more, 4 + more));
    const std::size_t before = checked.surface.triangles.size();
    open_ends(checked, openings);
    EXPECT_EQ(before - checked.surface.triangles.size(), 2U * 32 * 5) << "both ends, and no wall";
    ASSERT_EQ(checked.notes.size(), 1U);
    EXPECT_EQ(
        checked.notes[0],
        "2 flat ends with 320 triangles at the model's open ends are no wall, and left out; beside them nothing is "
        "observed");
    int beside = 0;
    for (const Closest& c : SignedSurface(checked.surface).closest(model.points)) {
      if (c.on_rim) continue;
      EXPECT_NEAR(c.distance, 0.2, 0.01) << more;
      ++beside;
    }
    EXPECT_GT(beside, model.points.cols() / 2);
  }
}

TEST(OpenEnds, WhatElseClosesASurfaceIsSaid) {
  const std::vector<Opening> openings = openings_of(lumen(tube(24, 10, 4, [](double) { return 1.0; })));
  CheckedSurface longer = checked_surface("a.stl", capped(1.2, -3, 4));
  open_ends(longer, openings);
  EXPECT_EQ(longer.notes,
            (Notes{"is closed, but shows a flat end at 1 of the model's 2 open ends only: what else closes "
                   "it counts as wall",
                   "1 flat ends with 160 triangles at the model's open ends are no wall, and left out; "
                   "beside them nothing is observed"}));
  CheckedSurface open = checked_surface("a.stl", tube(24, 10, 4, [](double) { return 1.2; }));
  open_ends(open, openings);
  EXPECT_EQ(open.surface.triangles.size(), 2U * 24 * 10);
  EXPECT_EQ(open.notes.size(), 1U) << "its own rims";
}

TEST(OpenEnds, MeanRadiusIsThatOfATube) {
  EXPECT_NEAR(mean_radius(tube(256, 10, 7, [](double) { return 1.5; })), 1.5, 1e-3);
  const LumenSurface model = lumen(tube(24, 10, 4, [](double) { return 1.0; }));
  const SignedSurface closed(closed_by_fans(model));
  EXPECT_GT(closed.closest(Vec3(0.2, 0, 0.01)).distance, 0) << "inside, beside the inlet";
  EXPECT_LT(closed.closest(Vec3(0.2, 0, -0.01)).distance, 0);
}

}  // namespace
}  // namespace tether::testing
