#include "vessel/anatomy/region_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "tests/vessel/anatomies/bifurcation.hpp"

namespace tether {
namespace region_rule_test {

constexpr double pi = std::numbers::pi;

RegionRule named(const std::string& name) {
  RegionRule rule;
  rule.name = name;
  return rule;
}

/// Areas by rule. What is left goes to one more.
std::vector<double> areas(const Points& points, const std::vector<Triangle>& triangles, std::vector<RegionRule> rules,
                          const Anatomy* anatomy, bool rest = true) {
  if (rest) rules.push_back(named("rest"));
  std::vector<double> result;
  for (const Patch& patch : divide_by_rules(points, triangles, rules, anatomy))
    result.push_back(area_of(points, patch));
  return result;
}

/// A region of each kind on the bifurcation; they overlap, the first takes a place.
std::vector<RegionRule> all_kinds(const Anatomy& anatomy) {
  std::vector<RegionRule> rules{named("spot"), named("sector"), named("box"), named("beyond")};
  Points curve(3, 2);
  curve << -1.4, -1.4, 0, 0, 1.5, 2.5;  // outside the wall, along it
  rules[0].near.push_back({curve, 0.7});
  rules[1].angle = AngleAbout{"trunk", -40, 60, {0, 1, 0}, Points(3, 0)};
  rules[1].along = AlongBranch{"trunk", 0.7, 5.3};
  rules[1].branches = {"trunk"};
  rules[2].box = InBox{{-2, -2, 0.4}, {2, 2, 1.1}};
  rules[3].planes.push_back({{0, 0, 5}, {0, 0.2, 1}});
  rules.push_back(named("branch"));
  rules.back().branches = {"branch"};
  for (const RegionRule& part : divided_along(named("trunk"), 3, anatomy)) rules.push_back(part);
  return rules;
}

TEST(RegionRules, AreasOnThreeMeshesOfTheSameLumenAgreeWithinOnePercent) {
  std::vector<std::vector<double>> on_mesh;
  for (const double edge : {0.3, 0.2, 0.12}) {
    const Bifurcation vessel = bifurcation(edge);
    const Anatomy anatomy(vessel.tree);
    on_mesh.push_back(areas(vessel.points, vessel.triangles, all_kinds(anatomy), &anatomy, false));
    double sum = 0;
    for (const double area : on_mesh.back()) sum += area;
    EXPECT_NEAR(sum, total_area(vessel.points, vessel.triangles), 1e-9);
  }
  for (std::size_t region = 0; region < on_mesh[0].size(); ++region)
    for (const std::size_t mesh : {0u, 1u})
      EXPECT_NEAR(on_mesh[mesh][region] / on_mesh[2][region], 1, 0.01) << region << " " << on_mesh[2][region];
}

TEST(RegionRules, AreasOfATubeAreTheKnownOnes) {
  const TubeSurface tube = tube_surface(1, 4, 60, 40);
  CentrelineTree tree;
  tree.branches.push_back({"tube", -1, {{0, 0, 0}, {0, 0, 4}}, {1, 1}});
  const Anatomy anatomy(tree);
  RegionRule sector = named("sector"), wide = named("wide"), toward = named("toward"), spot = named("spot");
  sector.angle = AngleAbout{"", 10, 50};
  sector.along = AlongBranch{"", 1, 3};
  wide.angle = AngleAbout{"tube", -100, 170};
  toward.angle = AngleAbout{"", -45, 45, {}, Vec3(0, -3, 2)};  // the axis seen from there: 270 degrees
  spot.near.push_back({Vec3(0, 1.3, 2), 0.5});
  const auto area = [&](const RegionRule& rule) { return areas(tube.points, tube.triangles, {rule}, &anatomy)[0]; };
  EXPECT_NEAR(area(sector), 2 * 40 * pi / 180, 2e-3 * area(sector));
  EXPECT_NEAR(area(wide), 4 * 270 * pi / 180, 2e-3 * area(wide));
  EXPECT_NEAR(area(toward), 4 * 90 * pi / 180, 2e-3 * area(toward));
  EXPECT_NEAR(area(spot), pi / 4, 5e-3 * area(spot));
  RegionRule both = toward;
  both.planes.push_back({{0, 0, 1.5}, {0, 0, 1}});
  EXPECT_NEAR(area(both), 2.5 * 90 * pi / 180, 2e-3 * area(both));
}

TEST(RegionRules, ABentTubeIsDividedAcrossItsLine) {
  const TubeSurface torus = torus_surface(4, 1, 24, 96);
  CentrelineTree tree;
  tree.branches.push_back({"arch", -1, {}, {}});
  for (int i = 0; i <= 24; ++i) {
    const double turn = pi * i / 24;
    tree.branches[0].points.emplace_back(4 * std::cos(turn), 4 * std::sin(turn), 0);
    tree.branches[0].radii.push_back(1);
  }
  const Anatomy anatomy(tree);
  RegionRule half = named("half");
  half.planes.push_back({{0, 0, 0}, {0, 1, 0}});
  std::vector<RegionRule> rules;
  for (RegionRule part : divided_along(named("part"), 4, anatomy)) {
    part.planes = half.planes;
    rules.push_back(part);
  }
  const std::vector<double> parts = areas(torus.points, torus.triangles, rules, &anatomy);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(parts[i], 4 * pi * pi / 1 * 4 / 8, 0.02 * parts[i]) << i;
  // the side of the bend, all along it: seen from the middle, half of the tube's outer side
  RegionRule inner = named("inner");
  inner.planes = half.planes;
  inner.angle = AngleAbout{"", -90, 90, {}, Vec3(0, 0, 0)};
  EXPECT_NEAR(areas(torus.points, torus.triangles, {inner}, &anatomy)[0], 4 * (pi * pi - 2 * pi / 4), 0.02 * 33);
}

TEST(RegionRules, MistakesAreToldWithTheirPlace) {
  const Bifurcation vessel = bifurcation(0.4);
  const Anatomy anatomy(vessel.tree);
  const auto fault = [&](const RegionRule& rule, bool rest = true) -> std::string {
    std::vector<RegionRule> rules{rule};
    if (rest) rules.push_back(named("rest"));
    try {
      divide_by_rules(vessel.points, vessel.triangles, rules, &anatomy);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  RegionRule rule = named("spine");
  rule.branches = {"carotid"};
  EXPECT_EQ(fault(rule), "regions.spine: the centreline has no branch 'carotid'; it has trunk, branch");
  rule.branches = {"branch"};
  EXPECT_NE(fault(rule, false).find("no region holds the outer wall near ("), std::string::npos) << fault(rule, false);
  rule.box = InBox{{5, 5, 5}, {6, 6, 6}};
  EXPECT_NE(fault(rule).find("regions.spine: holds no triangle"), std::string::npos) << fault(rule);
  rule = named("spine");
  rule.branches = {"branch"};
  rule.along = AlongBranch{"branch", 0, 1e-3};
  EXPECT_NE(fault(rule).find("takes all of it; its wall lies between "), std::string::npos) << fault(rule);
  EXPECT_NE(fault(rule).find(" along branch"), std::string::npos) << fault(rule);
  rule = named("spine");
  rule.near = {{Vec3(1630, 2280, 2200), 1.5}};
  EXPECT_NE(fault(rule).find("regions.spine: its point or curve lies 3"), std::string::npos) << fault(rule);
  EXPECT_NE(fault(rule).find("is it in another unit?"), std::string::npos) << fault(rule);
  rule = named("spine");
  rule.angle = AngleAbout{"trunk", -10, 10, {}, Vec3(1630, 2280, 2200)};
  EXPECT_NE(fault(rule).find("is it in another unit?"), std::string::npos) << fault(rule);
  rule.angle = AngleAbout{"trunk", -10, 10, {0, 0, 1}, Points(3, 0)};
  EXPECT_NE(fault(rule).find("angle zero is not known near ("), std::string::npos) << fault(rule);
}

}  // namespace region_rule_test
}  // namespace tether
