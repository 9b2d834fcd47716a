// solid.effects in a case file: blocks that can be appended, and what a wall makes of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solid/case.hpp"
#include "solid/list_effects.hpp"
#include "solid/server.hpp"
#include "solid/solid_solver.hpp"
#include "tests/config/case_text.hpp"
#include "tests/solid/tube.hpp"
#include "vessel/regions.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace {

constexpr const char* wall_text =
    "solid:\n"
    "  density: 1.1\n"
    "  material: {type: neo_hookean, young: 4e6, poisson: 0.45}\n"
    "  support: {regions: {wall: {stiffness: 1e5}}}\n"
    "  rings:\n"
    "    outlet_ring: {type: visco_elastic, stiffness: 1e6}\n";

PreparedWall wall_with(const std::string& effects) {
  const auto path = write_file("case.yaml", valid_head + wall_text + effects);
  CaseFile file(path);
  SolidCase solid;
  file.read("solid", solid);
  file.finish();
  return prepare_wall(solid, circular_tube(2, 2, 0.2, 8, 3).wall, file);
}

/// What a Hello says of a parameter.
protocol::ParameterInfo announced(const std::string& effects, const std::string& name) {
  const SolidServer server(wall_with(effects), UnitSystem::cgs(), "", test_folder());
  for (const protocol::ParameterInfo& info : server.hello().parameters)
    if (info.name == name) return info;
  ADD_FAILURE() << name << " is not announced";
  return {};
}

TEST(EffectsOfACase, AnyNumberActsOnOneRegion) {
  const PreparedWall wall = wall_with(
      "  effects:\n"
      "    spine: {type: contact, region: wall, stiffness: 1e5, gap: 1 mm}\n"
      "    fat: {type: tissue_mass, region: wall, mass: 0.5}\n"
      "    chest: {type: external_pressure, constant: 3 mmHg, period: 0.8}\n");
  ASSERT_EQ(wall.model->supports().size(), 5U);
  EXPECT_EQ(wall.model->supports()[2].effect().values(), (std::vector{1e5, 0.1, 0.02}));
  EXPECT_EQ(wall.model->supports()[4].triangles().size(), wall.model->mesh().outside[0].triangles.size());
}

TEST(EffectsOfACase, AreAnnouncedInTheCasesUnits) {
  const std::string text =
      "  effects:\n"
      "    spine: {type: contact, region: wall}\n"
      "    chest: {type: external_pressure, period: 0.8}\n";
  const auto stiffness = announced(text, "solid.effects.spine.stiffness");
  EXPECT_EQ(stiffness.unit, "g/(cm2 s2)");
  EXPECT_EQ(stiffness.absent, 0);
  EXPECT_EQ(stiffness.transform, "log2");
  EXPECT_EQ(stiffness.prior_deviation, 1);
  EXPECT_NEAR(stiffness.scale, 1e6, 1e-5) << "1e7 Pa/m";
  const auto pressure = announced(text, "solid.effects.chest.sine_2");
  EXPECT_EQ(pressure.transform, "linear");
  EXPECT_NEAR(pressure.prior_deviation, 5000, 1e-6) << "500 Pa";
  EXPECT_NEAR(pressure.scale, 5000, 1e-6);
}

TEST(EffectsOfACase, MotionTiesWhatHoldsTheWallThere) {
  write_file("heart.csv", "time,x,y,z\n0,0,0,0\n1,0,0,1\n");
  const PreparedWall wall = wall_with(
      "  effects:\n"
      "    breath: {type: breathing, region: wall, amplitude_z: 2 mm, period: 4}\n"
      "    heart: {type: measured_motion, region: outlet_ring, factor: 0, motion: {file: heart.csv}}\n");
  EXPECT_EQ(wall.model->supports()[0].tissues().at(0)->path, "solid.effects.breath");
  EXPECT_EQ(wall.model->supports()[1].tissues().at(0)->path, "solid.effects.heart");
  wall.model->parameters().set("solid.effects.heart.factor", 0.5);
}

TEST(EffectsOfACase, AClampedRingGoesWithTissueThatMoves) {
  const PreparedWall wall = wall_with("  effects: {heart: {type: moving_tissue, region: inlet_ring, period: 0.8}}\n");
  WallModel& model = *wall.model;
  EXPECT_TRUE(model.driven().empty()) << "absent, it is a clamp";
  const auto clamped = model.clamped_unknowns();
  model.parameters().set("solid.effects.heart.z_cosine_1", 0.3);
  model.parameters().set("solid.effects.heart.x_sine_2", -0.1);
  ASSERT_EQ(model.driven().size(), 1U);
  EXPECT_EQ(model.driven()[0].name, "inlet_ring");
  EXPECT_EQ(model.clamped_unknowns(), clamped);
  const Anchor& anchor = model.driven()[0].anchor;
  EXPECT_EQ(anchor.at(0).offset.norm(), 0);
  EXPECT_LT((anchor.at(0.4).offset - Vec3(0, 0, -0.6)).norm(), 1e-12) << "half a beat: cos - 1 = -2";
  EXPECT_LT((anchor.at(0.5).offset - Vec3(-0.1, 0, 0.3 * (std::cos(1.25 * std::numbers::pi) - 1))).norm(), 1e-12);
  SolidSolver solver(model);
  solver.begin_step(0, 0.1);
  solver.evaluate(Points::Zero(3, model.mesh().interface_nodes));
  solver.accept();
  for (const int node : model.driven()[0].nodes)
    EXPECT_LT((solver.displacement().col(node) - anchor.at(0.1).offset).norm(), 1e-14);
}

TEST(EffectsOfACase, ALoosenedRingIsPulledByItsTissueAndDrivenNoMore) {
  const PreparedWall wall = wall_with(
      "  effects:\n"
      "    loose: {type: loose_ring, region: inlet_ring}\n"
      "    heart: {type: moving_tissue, region: inlet_ring, period: 0.8, y_sine_1: 2 mm}\n");
  WallModel& model = *wall.model;
  ASSERT_EQ(model.driven().size(), 1U);
  EXPECT_EQ(model.supports()[2].tissues().at(0)->path, "solid.effects.heart");
  model.parameters().set("solid.effects.loose.compliance", 1e-5);
  EXPECT_TRUE(model.driven().empty());
  EXPECT_TRUE(model.clamped_unknowns().empty());
}

/// Parts of the wall that a diagnosis may find to be held by tissue that moves.
std::vector<std::string> parts_with_moving_tissue(const std::string& more) {
  const auto path = write_file("case.yaml", valid_head + wall_text + more);
  CaseFile file(path);
  SolidCase solid;
  file.read("solid", solid);
  std::vector<std::string> parts;
  for (const PossibleEffect& e : list_effects(solid, circular_tube(2, 2, 0.2, 8, 3).wall, file.units()).possible)
    if (e.type == "moving_tissue") {
      parts.push_back(e.part);
      EXPECT_TRUE(e.generic);
      EXPECT_EQ(e.amplitudes.size(), 12U);
      EXPECT_EQ(e.required, std::vector<std::string>{"period"});
    }
  return parts;
}

TEST(EffectsOfACase, TissueMayMoveWhereItHoldsTheWall) {
  using Parts = std::vector<std::string>;
  EXPECT_EQ(parts_with_moving_tissue(""), (Parts{"inlet_ring", "outlet_ring", "wall"}));
  EXPECT_EQ(parts_with_moving_tissue("    inlet_ring: {type: free}\n"), (Parts{"outlet_ring", "wall"}));
  EXPECT_EQ(parts_with_moving_tissue("  effects: {e: {type: moving_tissue, region: outlet_ring, period: 1}}\n"),
            (Parts{"inlet_ring", "wall"}));
}

TEST(EffectsOfACase, ALooseRingIsHeldOnlyByItsCompliance) {
  const PreparedWall wall = wall_with("  effects: {heart: {type: loose_ring, region: inlet_ring}}\n");
  EXPECT_FALSE(wall.model->clamped_unknowns().empty());
  wall.model->parameters().set("solid.effects.heart.compliance", 1e-5);
  EXPECT_TRUE(wall.model->clamped_unknowns().empty());
}

TEST(EffectsOfACase, AFormulaIsAnEffectLikeAnyOther) {
  const std::string text =
      "  effects:\n"
      "    odd:\n"
      "      type: expression\n"
      "      region: wall\n"
      "      normal: -k*un*abs(un)\n"
      "      parameters: {k: {value: 0, absent: 0, lower: 0, transform: log2, prior_deviation: 1, scale: 1e5}}\n";
  EXPECT_TRUE(wall_with(text).model->supports().back().effect().is_absent());
  const auto k = announced(text, "solid.effects.odd.k");
  EXPECT_EQ(k.transform, "log2");
  EXPECT_EQ(k.lower, 0);
  EXPECT_EQ(k.scale, 1e5);
}

TEST(EffectsOfACase, MistakesAreNamedWithTheirLine) {
  const auto error = [](const std::string& text) {
    return input_error_of([&] { wall_with("  effects:\n    e: " + text + "\n"); });
  };
  EXPECT_NE(error("{type: contact, region: spin}").find("case.yaml:13: solid.effects.e.region"), std::string::npos)
      << error("{type: contact, region: spin}");
  EXPECT_NE(error("{type: loose_ring, region: wall}").find("end ring"), std::string::npos);
  EXPECT_NE(error("{type: contract}").find("did you mean 'contact'"), std::string::npos);
  EXPECT_NE(error("{type: measured_motion}").find("needs a section 'motion'"), std::string::npos);
  EXPECT_NE(
      input_error_of([] {
        wall_with("    inlet_ring: {type: free}\n  effects: {e: {type: breathing, region: inlet_ring, period: 4}}\n");
      }).find("nothing holds the wall there"),
      std::string::npos);
  EXPECT_NE(error("{type: stiffening, cubic: -1}").find("must not be negative"), std::string::npos);
  EXPECT_NE(error("{type: expression, normal: -k*un}").find("case.yaml:13: solid.effects.e"), std::string::npos);
  EXPECT_NE(error("{type: expression}").find("needs 'normal'"), std::string::npos);
  for (const std::string& formula :
       {std::string(60'000, '-') + "un", std::string(60'000, 'k'), "k=" + std::string(60'000, '3'),
        "1,2" + std::string(60'000, '0'), "1/0" + std::string(60'000, ' ')}) {
    const std::string said = error("{type: expression, normal: \"" + formula + "\"}");
    EXPECT_TRUE(said.find("case.yaml:13: solid.effects.e: \"") != std::string::npos && said.size() < 500)
        << said.substr(0, 2000);
  }
  EXPECT_NE(error("{type: fibres, region: inlet_ring}").find("not in a ring"), std::string::npos);
  EXPECT_NE(error("{type: traction}").find("period"), std::string::npos);
  EXPECT_NE(
      error("{type: loose_ring, region: inlet_ring, to: 0.5}").find("are of what acts in regions of the outer wall"),
      std::string::npos);
  EXPECT_NE(error("{type: contact, region: wall, from: 0.5, to: 0.5}").find("must be beyond 'from'"),
            std::string::npos);
}

/// A tube whose outer wall is divided around: spine, left, right and the rest.
WallMesh divided_tube() {
  SweepSettings settings = circular_tube_settings(2, 4, 0.2, 16, 6);
  settings.regions = {{"spine", 150, 210}, {"left", 105, 150}, {"right", 210, 255}, {"wall"}};
  return sweep(settings).wall;
}

PreparedWall divided_wall_with(const std::string& effects) {
  const auto path = write_file("case.yaml", valid_head + wall_text + effects);
  CaseFile file(path);
  SolidCase solid;
  file.read("solid", solid);
  file.finish();
  return prepare_wall(solid, divided_tube(), file);
}

TEST(EffectsOfACase, ASupportActsOnWhatIsNearerToANeighbour) {
  const auto force = [](const std::string& more) {
    const PreparedWall wall =
        divided_wall_with("  effects: {e: {type: visco_elastic, region: spine, stiffness: 1e5" + more + "}}\n");
    const Points moved = Points::Constant(3, wall.model->mesh().points.cols(), 0.01),
                 still = Points::Zero(3, moved.cols());
    return wall.model->supports()[2].resultant({moved, still, 0, 1e-3})[0];
  };
  const double all = force(""), left = force(", toward: left"), right = force(", toward: right");
  EXPECT_NEAR(left / all, 0.5, 1e-9) << "the mesh is the same on both sides";
  EXPECT_NEAR((left + right) / all, 1, 1e-9);
  EXPECT_NEAR(force(", toward: left, from: 0.5") / all, 0.25, 1e-9);
}

/// Of the whole wall's stiffness matrix, what a stiffer part adds is what its two parts add.
TEST(EffectsOfACase, TheWallDiffersInWhatIsNearerToANeighbour) {
  const auto energy = [](const std::string& more) {
    const PreparedWall wall =
        divided_wall_with("  effects: {e: {type: stiffness_factor, region: spine, factor: 3" + more + "}}\n");
    Points moved = wall.model->mesh().points;
    moved.row(2).setZero();
    moved *= 1e-3;  // wider all around
    const Points still = Points::Zero(3, moved.cols());
    const VectorXd force = wall.model->step_forces(moved, still, still, 0, 1e-3, nullptr);
    return force.dot(moved.reshaped());
  };
  const double none = energy(", from: 0.5, to: 0.5001"), all = energy("") - none,
               left = energy(", toward: left") - none, right = energy(", toward: right") - none;
  EXPECT_GT(all, 0);
  EXPECT_NEAR(left / all, 0.5, 0.002);
  EXPECT_NEAR((left + right) / all, 1, 0.002);
}

constexpr double pi = std::numbers::pi;

/// A ball of radius r about a place on a cylinder cuts a patch of area pi r^2 (1 - O(r^2/R^2)) out of it, whatever the
/// mesh: here r is half an element's edge up to three edges.
TEST(EffectsOfACase, WhatIsNearAPointHasItsAreaOnAnyMesh) {
  const auto area = [](int around, double radius) {
    const WallMesh wall = circular_tube(2, 10, 0.2, around, around).wall;
    const Vec3 centre(2.2, 0.1, 5.1);  // on the outer wall, at no node
    double sum = 0;
    for (const Patch& region : wall.outside) {
      const NearAndFar sides = divided_by_distance(region, wall.points, centre, radius);
      EXPECT_NEAR(area_of(wall.points, sides.near) + area_of(wall.points, sides.far), area_of(wall.points, region),
                  1e-9);
      sum += area_of(wall.points, sides.near);
    }
    return sum;
  };
  for (const double radius : {0.3, 0.6, 1.5}) {
    const double finest = area(64, radius);
    EXPECT_NEAR(finest / (pi * radius * radius), 1, 0.01 + 0.1 * std::pow(radius / 2.2, 2));
    for (const int around : {16, 24, 32})
      EXPECT_NEAR(area(around, radius) / finest, 1, 0.02) << around << " " << radius;
  }
}

TEST(EffectsOfACase, ASupportActsOnWhatIsNearAPoint) {
  const auto force = [](const std::string& more) {
    const PreparedWall wall = divided_wall_with("  effects: {e: {type: visco_elastic, stiffness: 1e5" + more + "}}\n");
    const Points moved = Points::Constant(3, wall.model->mesh().points.cols(), 0.01),
                 still = Points::Zero(3, moved.cols());
    return -wall.model->supports()[2].resultant({moved, still, 0, 1e-3})[0];
  };
  const std::string about = ", about: {point: [-1.905, 1.1, 2], within: 0.5}";  // where spine and left meet
  EXPECT_NEAR(force(about) / (1e5 * 0.01 * pi * 0.25), 1, 0.02);
  EXPECT_NEAR(force(about + ", region: spine") / force(about), 0.5, 0.02);
  EXPECT_NEAR((force(about + ", region: spine") + force(about + ", region: left")) / force(about), 1, 1e-3) << "chords";
  EXPECT_NEAR(force(about + ", from: 0.5") / force(about), 0.5, 1e-3);
}

/// A stiffer part adds to the energy of a stretch what its share of the wall is, and two parts what both add.
TEST(EffectsOfACase, TheWallDiffersNearPoints) {
  const auto energy = [](const std::string& effects) {
    const PreparedWall wall = divided_wall_with("  effects:\n" + effects);
    Points moved = wall.model->mesh().points;
    moved.row(2).setZero();
    moved *= 1e-3;
    const Points still = Points::Zero(3, moved.cols());
    return wall.model->step_forces(moved, still, still, 0, 1e-3, nullptr).dot(moved.reshaped());
  };
  const std::string one = "    a: {type: stiffness_factor, factor: 3, about: {point: [2.2, 0, 1.8], within: 0.5}}\n",
                    overlapping =
                        "    b: {type: stiffness_factor, factor: 3, about: {point: [2.2, 0, 2.1], within: 0.5}}\n";
  const std::string absent = "    c: {type: stiffness_factor, factor: 1}\n",
                    all = "    c: {type: stiffness_factor, factor: 3, from: 0.25, to: 0.75}\n";
  const double none = energy(absent), whole = energy(all) - none, first = energy(one) - none,
               second = energy(overlapping) - none;
  const double area = 2 * pi * 2.2 * 2;
  EXPECT_NEAR(first / whole / (pi * 0.25 / area), 1, 0.05);
  EXPECT_NEAR(second / first, 1, 0.05);
  // where both act the wall is nine times as stiff: of what one adds (2) the overlap adds 8 - 2 - 2 more
  const double lens = 2 * 0.25 * std::acos(0.3) - 0.15 * std::sqrt(1 - 0.09);
  EXPECT_NEAR((energy(one + overlapping) - none - first - second) / (first / (pi * 0.25)), 2 * lens, 0.15 * lens);
}

TEST(EffectsOfACase, APointFarFromTheWallIsRefused) {
  const std::string error = input_error_of([] {
    divided_wall_with("  effects:\n    e: {type: contact, region: spine, about: {point: [20, 0, 1], within: 0.5}}\n");
  });
  EXPECT_NE(error.find("solid.effects.e.about: nothing of spine is within 0.5 cm of it: the nearest place is 2"),
            std::string::npos)
      << error;
}

TEST(EffectsOfACase, PartsOfARegionAreOfferedTowardEachNeighbour) {
  const auto path = write_file("case.yaml", valid_head + wall_text);
  CaseFile file(path);
  SolidCase solid;
  file.read("solid", solid);
  std::vector<std::string> parts;
  for (const PossibleEffect& e : list_effects(solid, divided_tube(), file.units()).possible)
    if (e.type == "contact" && e.part == "spine") parts.push_back(in_words(e.extent, "cm"));
  EXPECT_EQ(parts,
            (std::vector<std::string>{"", "inlet half", "outlet half", "middle half", "toward left", "toward right"}));
}

TEST(EffectsOfACase, ANeighbourThatIsNoneIsRefused) {
  const auto error = [](const std::string& text) {
    return input_error_of([&] { divided_wall_with("  effects:\n    e: {type: contact, " + text + "}\n"); });
  };
  EXPECT_NE(error("region: spine, toward: wall")
                .find("solid.effects.e.toward: wall: is not beside spine; there are "
                      "left, right"),
            std::string::npos)
      << error("region: spine, toward: wall");
  EXPECT_NE(error("toward: left").find("needs 'region'"), std::string::npos);
  EXPECT_NE(error("region: inlet_ring, toward: left").find("of what acts in regions of the outer wall"),
            std::string::npos);
}

/// Of the area in which it acts, a support has what lies between: a tube's half, wherever its triangles are.
TEST(EffectsOfACase, ASupportActsBetweenTwoPlacesAlongTheVessel) {
  const auto force = [](const std::string& more) {
    const PreparedWall wall =
        wall_with("  effects: {spine: {type: visco_elastic, region: wall, stiffness: 1e5" + more + "}}\n");
    const Points moved = Points::Constant(3, wall.model->mesh().points.cols(), 0.01),
                 still = Points::Zero(3, moved.cols());
    return wall.model->supports()[2].resultant({moved, still, 0, 1e-3})[0];
  };
  const double all = force("");
  EXPECT_NEAR(force(", to: 0.5") / all, 0.5, 1e-9);
  EXPECT_NEAR(force(", from: 0.13, to: 0.47") / all, 0.34, 1e-9);
  EXPECT_NEAR(force(", from: 0.47") / all, 0.53, 1e-9);
}

}  // namespace
}  // namespace tether
