#include <gtest/gtest.h>

#include <numbers>

#include "solid/initial_stress.hpp"
#include "solid/materials/registry.hpp"
#include "solid/prestress.hpp"
#include "solid/rest.hpp"
#include "solid/wall_share.hpp"
#include "tests/solid/follower_pressure.hpp"
#include "tests/solid/report.hpp"
#include "tests/vessel/anatomies/closed_bifurcation.hpp"
#include "vessel/model/vessel_model.hpp"

// The imaged wall of a branching lumen whose sections are not round, under its pressure. Units: cm, g, s; 80 mmHg.
namespace tether {
namespace branching_test {

constexpr double pressure = 80 * 1333.22, radius = Bifurcation::trunk_radius;

constexpr double flatter = 0.92;

/// Tension alone is the same all around a tube, p over the mean curvature; the curvature of the ellipse
/// r (1 + d cos 2 theta), d = (1 - flatter)/(1 + flatter), is (1 + 3 d cos 2 theta)/r. What is left is 3 d cos 2 theta
/// of the pressure.
constexpr double share_of_an_elliptic_tube = 3 * (1 - flatter) / (1 + flatter) * 2 / std::numbers::pi;

/// The trunk an ellipse of axes 8 % apart.
WallMesh vessel(double thickness) {
  LabelledSurface lumen = closed_bifurcation(0.4);
  lumen.points.row(1) *= flatter;
  VolumeCase study;
  study.wall.thickness.thickness = thickness;
  study.wall.least_share = 0.5;
  return build_model(lumen, bifurcation(0.4).tree, study, UnitSystem::cgs()).mesh.wall;
}

std::vector<int> clamped_ends(const WallMesh& wall) {
  std::vector<int> nodes;
  for (const Patch& ring : wall.rings)
    for (const int node : nodes_of(ring.triangles)) nodes.push_back(node);
  return nodes;
}

TEST(BranchingWall, ThatIsStiffHasAStressFreeShapeWhichInflatesToTheImage) {
  const WallMesh wall = vessel(0.25);
  const auto material = neo_hookean.make(std::array{1e7, 0.45});
  const std::vector<int> fixed = unknowns_of(clamped_ends(wall));
  const StressFreeResult found = stress_free_configuration(wall, *material, pressure, fixed, wall_share(wall, alone()));
  ASSERT_TRUE(found.converged) << found.reached << " " << found.failure;
  const Points inflated = inflate(wall, found.positions, *material, pressure, fixed, 1e-10);
  const double error = (inflated - wall.points).cwiseAbs().maxCoeff() / radius;
  report("branching_stress_free_then_inflated", error);
  report("branching_stress_free_moved", (found.positions - wall.points).colwise().norm().maxCoeff() / radius);
  EXPECT_LE(error, 1e-8) << "ten times what the search leaves of a correction";
}

/// As thin and as soft as an artery: the search says how far it came and why no farther; the prestress needs no shape.
TEST(BranchingWall, LikeAnArterysHasNone) {
  const WallMesh wall = vessel(0.12);
  const auto material = neo_hookean.make(std::array{2e6, 0.45});
  const std::vector<int> nodes = clamped_ends(wall);
  const StressFreeResult found =
      stress_free_configuration(wall, *material, pressure, unknowns_of(nodes), wall_share(wall, alone()));
  EXPECT_FALSE(found.converged);
  EXPECT_LT(found.reached, 1);
  EXPECT_FALSE(found.failure.empty());
  report("branching_reached", found.reached);

  const WallSettings settings{.material = "neo_hookean", .material_values = {2e6, 0.45}, .density = 1.2};
  WallModel model(wall, settings, wall.points, nodes, {});
  const InitialStress initial = find_initial_stress(wall, model.material(), pressure, wall_share(wall, alone()));
  model.set_initial_stress(initial);
  ImageCase image;
  image.pressure = pressure;
  image.wall = "prestressed";
  const RestState rest = rest_of(model, image, &initial);
  EXPECT_LE(rest.residual.value(), 1e-10);
  ASSERT_TRUE(rest.held.has_value());
  report("branching_held_share", rest.held->share);
  EXPECT_GT(rest.held->share, 0.9 * share_of_an_elliptic_tube);
  EXPECT_LT(rest.held->share, 1.5 * share_of_an_elliptic_tube) << "the crotch adds some";
  EXPECT_GT(rest.held->largest, rest.held->share) << "the largest of a mean";
}

TEST(BranchingWall, ThatNothingClampsIsNotSought) {
  const WallMesh wall = vessel(0.25);
  const auto material = neo_hookean.make(std::array{1e7, 0.45});
  const StressFreeResult found = stress_free_configuration(wall, *material, pressure, {}, wall_share(wall, alone()));
  EXPECT_FALSE(found.converged);
  EXPECT_EQ(found.iterations, 0);
  EXPECT_NE(found.failure.find("no end of the wall is clamped"), std::string::npos);
}

}  // namespace branching_test
}  // namespace tether
