#include "vessel/sweep.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "tests/mesh/mesh_assertions.hpp"
#include "vessel/polar_curve.hpp"
#include "vessel/quality.hpp"
#include "vessel/regions.hpp"

namespace tether {
namespace sweep_test {

constexpr double pi = std::numbers::pi;

TEST(CircularTube, is_conforming_oriented_and_matching) {
  const VesselMesh tube = circular_tube(2, 10, 0.2, 24, 20);
  expect_valid(tube.fluid);
  expect_valid(tube.wall);
  expect_matching(tube, 0);
}

TEST(CircularTube, has_the_papers_size_and_good_elements) {
  const VesselMesh tube = circular_tube(2, 10, 0.2, 24, 20);
  EXPECT_EQ(tube.fluid.points.cols(), 2037);
  EXPECT_EQ(tube.wall.points.cols(), 24 * 21 * 3);
  EXPECT_EQ(tube.wall.prisms.size(), 24u * 20u * 2u * 2u);
  const Quality q = quality(tube.fluid.points, tube.fluid.tetrahedra);
  RecordProperty("fluid", fmt::format("tets {} min {:.3f} mean {:.3f} dihedral {:.1f}", tube.fluid.tetrahedra.size(),
                                      q.min_radius_ratio, q.mean_radius_ratio, q.min_dihedral));
  EXPECT_GT(q.min_radius_ratio, 0.3);
  EXPECT_GT(q.mean_radius_ratio, 0.6);
  EXPECT_GT(q.min_dihedral, 12);
}

/// The lumen is a prism over a regular polygon, the wall the shell between two of them: volumes in closed form, O(h^2)
/// from the circle's.
TEST(CircularTube, volumes_are_those_of_polygons) {
  for (const int around : {16, 32, 64}) {
    const VesselMesh tube = circular_tube(2, 10, 0.2, around, 6);
    const double polygon = 0.5 * around * std::sin(2 * pi / around);
    EXPECT_NEAR(total_volume(tube.fluid.points, tube.fluid.tetrahedra), polygon * 4 * 10, 1e-10);
    EXPECT_NEAR(total_volume(tube.wall.points, split_into_tetrahedra(tube.wall.prisms)), polygon * (2.2 * 2.2 - 4) * 10,
                1e-10);
    EXPECT_NEAR(1 - polygon / pi, 2 * pi * pi / 3 / (around * around), 20.0 / std::pow(around, 4));
  }
}

TEST(CircularTube, wall_nodes_lie_on_cylinders_and_rings_in_end_planes) {
  const VesselMesh tube = circular_tube(2, 10, 0.3, 24, 8, 3);
  const int nodes = tube.wall.interface_nodes;
  for (Eigen::Index i = 0; i < tube.wall.points.cols(); ++i) {
    const Vec3 x = tube.wall.points.col(i);
    EXPECT_NEAR(std::hypot(x[0], x[1]), 2 + 0.1 * static_cast<double>(i / nodes), 1e-12);
    EXPECT_NEAR(x[2], tube.wall.points(2, i % nodes), 1e-12);
  }
  ASSERT_EQ(tube.wall.rings.size(), 2u);
  for (const Patch& ring : tube.wall.rings)
    for (const int node : nodes_of(ring.triangles))
      EXPECT_NEAR(tube.wall.points(2, node), ring.name == "inlet_ring" ? 0 : 10, 1e-12);
}

TEST(CircularTube, lumen_mesh_has_no_sense_of_rotation) {
  const VesselMesh tube = circular_tube(2, 10, 0.2, 16, 2);
  for (const Triangle& t : tube.fluid.interface) {  // each has its mirror image in the plane y = 0
    const auto mirrored = [&](int node) {
      const Vec3 image(tube.fluid.points(0, node), -tube.fluid.points(1, node), tube.fluid.points(2, node));
      Eigen::Index found = 0;
      EXPECT_LT((tube.fluid.points.colwise() - image).colwise().norm().minCoeff(&found), 1e-12);
      return static_cast<int>(found);
    };
    const Triangle image = sorted({mirrored(t[0]), mirrored(t[1]), mirrored(t[2])});
    EXPECT_TRUE(std::any_of(tube.fluid.interface.begin(), tube.fluid.interface.end(),
                            [&](const Triangle& other) { return sorted(other) == image; }));
  }
}

TEST(CircularTube, large_mesh_reaches_the_papers_second_size) {
  const VesselMesh tube = circular_tube(2, 10, 0.2, 60, 50, 5);
  EXPECT_NEAR(static_cast<double>(tube.fluid.points.cols()), 23000, 2500);
  EXPECT_NEAR(static_cast<double>(tube.wall.points.cols()), 18000, 1000);
  const Quality q = quality(tube.fluid.points, tube.fluid.tetrahedra);
  EXPECT_GT(q.min_radius_ratio, 0.3);
  RecordProperty("fluid",
                 fmt::format("nodes {} tets {} min {:.3f} mean {:.3f} dihedral {:.1f}", tube.fluid.points.cols(),
                             tube.fluid.tetrahedra.size(), q.min_radius_ratio, q.mean_radius_ratio, q.min_dihedral));
}

TEST(SweepRegions, follow_angle_and_position_and_first_match_wins) {
  SweepSettings settings = circular_tube_settings(2, 10, 0.2, 24, 20);
  settings.regions = {{"spine", 150, 210}, {"around_zero", 330, 30, 0.5, 1}, {"vicinity", 105, 255}, {"opposite"}};
  const VesselMesh tube = sweep(settings);
  expect_valid(tube.wall);
  ASSERT_EQ(tube.wall.outside.size(), 4u);
  const auto area = [&](std::size_t i) { return total_area(tube.wall.points, tube.wall.outside[i].triangles); };
  const double whole = 24 * 2 * 2.2 * std::sin(pi / 24) * 10;
  EXPECT_NEAR(area(0), whole / 6, 1e-10);
  EXPECT_NEAR(area(1), whole / 6 / 2, 1e-10);
  EXPECT_NEAR(area(2), whole * (150 - 60) / 360, 1e-10);
  EXPECT_NEAR(area(3), whole * (1 - 150. / 360 - 1. / 12), 1e-10);
  EXPECT_LT(centroid(tube.wall.points, tube.wall.outside[0].triangles)[0], -1.9);  // 180 degrees from +x
  EXPECT_GT(centroid(tube.wall.points, tube.wall.outside[1].triangles)[2], 7);
}

/// Borders cut triangles: a region's share of the wall is that of its angles and positions, on any mesh.
TEST(SweepRegions, areas_do_not_depend_on_the_mesh) {
  for (const auto& [around, along] : {std::pair{10, 7}, {16, 13}, {22, 9}, {38, 31}}) {
    SweepSettings settings = circular_tube_settings(2, 10, 0.2, around, along);
    settings.regions = {
        {"spine", 150, 217}, {"around_zero", 335, 30, 0.5, 1}, {"vicinity", 105, 250, 0.1, 0.83}, {"opposite"}};
    const VesselMesh tube = sweep(settings);
    expect_valid(tube.wall);
    std::vector<double> shares;
    double whole = 0;
    for (const Patch& region : tube.wall.outside) {
      shares.push_back(area_of(tube.wall.points, region));
      whole += shares.back();
    }
    EXPECT_NEAR(whole, around * 2 * 2.2 * std::sin(pi / around) * 10, 1e-10);
    const double of_spine = 67. / 360, around_zero = 0.5 * 55 / 360, vicinity = 0.73 * (145 - 67) / 360;
    EXPECT_NEAR(shares[0] / whole, of_spine, 1e-10);
    EXPECT_NEAR(shares[1] / whole, around_zero, 1e-10);
    EXPECT_NEAR(shares[2] / whole, vicinity, 1e-10);
    EXPECT_NEAR(shares[3] / whole, 1 - of_spine - around_zero - vicinity, 1e-10);
  }
}

/// Where a region is nearer to one neighbour than to the others does not depend on the mesh either: with two neighbours
/// the half, with four what is nearest.
TEST(SweepRegions, what_is_nearer_to_a_neighbour_does_not_depend_on_the_mesh) {
  for (const auto& [around, along] : {std::pair{16, 13}, {22, 18}, {38, 31}}) {
    SweepSettings settings = circular_tube_settings(2, 10, 0.2, around, along);
    settings.regions = {{"spine", 150, 217}, {"left", 105, 150}, {"right", 217, 255}, {"opposite"}};
    const WallMesh wall = sweep(settings).wall;
    EXPECT_EQ(neighbours_of(wall.outside).at("spine"), (std::vector<std::string>{"left", "right"}));
    const VectorXd near = nearness("left", "spine", wall.outside, wall.points);
    const double all = area_of(wall.points, wall.outside[0]),
                 half = area_of(wall.points, part_between(wall.outside[0], near, 0, 1));
    EXPECT_NEAR(half / all, 0.5, 0.005) << around;
    EXPECT_NEAR(area_of(wall.points, part_between(wall.outside[0], near, -1, 0)), all - half, 1e-9);
  }
}

/// First moments, too: the parts lie where the region is.
TEST(SweepRegions, parts_lie_within_their_region) {
  SweepSettings settings = circular_tube_settings(2, 10, 0.2, 18, 7);
  settings.regions = {{"slice", 0, 360, 0.21, 0.47}, {"rest"}};
  const WallMesh wall = sweep(settings).wall;
  double lowest = 10, highest = 0;
  for (const TrianglePart& part : parts_of(wall.outside[0])) {
    const Eigen::RowVector3d z = wall.points(2, part.of) * part.corners;
    lowest = std::min(lowest, z.minCoeff()), highest = std::max(highest, z.maxCoeff());
  }
  EXPECT_NEAR(lowest, 2.1, 1e-8);
  EXPECT_NEAR(highest, 4.7, 1e-8);
}

TEST(SweepRegions, borders_along_edges_cut_nothing) {
  SweepSettings settings = circular_tube_settings(2, 10, 0.2, 24, 20);
  settings.regions = {{"spine", 150, 210}, {"around_zero", 330, 30, 0.5, 1}, {"opposite"}};
  for (const Patch& region : sweep(settings).wall.outside) EXPECT_TRUE(region.parts.empty()) << region.name;
}

TEST(SweepRegions, angles_are_right_handed_about_the_flow) {
  SweepSettings settings = circular_tube_settings(2, 10, 0.2, 24, 20);
  settings.regions = {{"quarter", 60, 120}, {"rest"}};
  EXPECT_GT(centroid(sweep(settings).wall.points, sweep(settings).wall.outside[0].triangles)[1], 2.0);  // +y
  std::swap(settings.sections[0], settings.sections[1]);                                                // flow along -z
  const VesselMesh reversed = sweep(settings);
  expect_valid(reversed.fluid);
  EXPECT_LT(centroid(reversed.wall.points, reversed.wall.outside[0].triangles)[1], -2.0);
}

TEST(SweepRegions, holes_and_empty_regions_are_named) {
  SweepSettings settings = circular_tube_settings(2, 10, 0.2, 24, 20);
  settings.regions = {{"spine", 150, 210}};
  EXPECT_THROW(sweep(settings), InputError);
  settings.regions = {{"all"}, {"never", 0, 90}};
  try {
    sweep(settings);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mesh.swept.regions: never holds no triangle"), std::string::npos);
  }
}

/// Oblique cuts of a straight elliptical cylinder give back that cylinder, with cuts across its axis.
TEST(Sweep, oblique_sections_of_a_cylinder_give_the_cylinder) {
  const Vec3 tilt = Vec3(0.5, 0, 0.9).normalized();
  SweepSettings settings = circular_tube_settings(2, 10, 0.2, 48, 20);
  settings.angle_origin = {0, 1, 0};
  settings.sections.clear();
  for (const double z : {0.0, 4.0, 9.0}) {
    Points section(3, 72);
    for (int i = 0; i < 72; ++i) {
      const double a = 2 * pi * i / 72, x = 2 * std::cos(a), y = 1.8 * std::sin(a);
      section.col(i) << x, y, z - tilt[0] / tilt[2] * x;
    }
    settings.sections.push_back(z == 4 ? Points(section.rowwise().reverse()) : section);  // either sense will do
  }
  settings.extend_inlet = settings.extend_outlet = 3;
  const VesselMesh vessel = sweep(settings);
  expect_valid(vessel.fluid);
  expect_valid(vessel.wall);
  expect_matching(vessel, 0);
  for (const int node : nodes_of(vessel.fluid.interface)) {
    const Vec3 x = vessel.fluid.points.col(node);
    EXPECT_NEAR(std::hypot(x[0] / 2, x[1] / 1.8), 1, 2e-4);
  }
  const std::vector<CrossSection> sections = cross_sections(settings);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    EXPECT_NEAR((sections[i].centre - Vec3(0, 0, -3 + 0.75 * static_cast<double>(i))).norm(), 0, 1e-3);
    EXPECT_NEAR(sections[i].normal[2], 1, 1e-6);
  }
  EXPECT_NEAR(total_volume(vessel.fluid.points, vessel.fluid.tetrahedra), 24 * std::sin(2 * pi / 48) * 2 * 1.8 * 15,
              0.02);
}

Points ring_of_torus(double bend, double radius, double angle) {
  const Vec3 outward(std::cos(angle), 0, std::sin(angle)), flow(-std::sin(angle), 0, std::cos(angle));
  return circle(make_frame(bend * outward, flow, {0, 1, 0}), radius, 64);
}

/// A quarter of a torus: volume pi^2 r^2 R / 2 and wall volume by Pappus, approached as h^2.
TEST(Sweep, volume_of_a_bend_converges_with_second_order) {
  std::vector<double> errors, wall_errors;
  const double exact = pi * pi / 2 * 6, exact_wall = pi * pi / 2 * 6 * (1.2 * 1.2 - 1);
  for (const int n : {12, 24, 48}) {
    SweepSettings settings = circular_tube_settings(1, 1, 0.2, n, n);
    settings.angle_origin = {0, 1, 0};
    settings.sections.clear();
    for (int k = 0; k <= 32; ++k) settings.sections.push_back(ring_of_torus(6, 1, pi / 2 * k / 32));
    const VesselMesh vessel = sweep(settings);
    errors.push_back(exact - total_volume(vessel.fluid.points, vessel.fluid.tetrahedra));
    wall_errors.push_back(exact_wall - total_volume(vessel.wall.points, split_into_tetrahedra(vessel.wall.prisms)));
    if (n == 24) {
      expect_valid(vessel.fluid);
      expect_valid(vessel.wall);
    }
  }
  for (const auto& e : {errors, wall_errors})
    for (const std::size_t i : {1u, 2u}) EXPECT_NEAR(std::log2(e[i - 1] / e[i]), 2, 0.1) << e[i - 1] << " " << e[i];
}

TEST(Sweep, wrong_settings_are_named) {
  const auto message = [](auto change) {
    SweepSettings settings = circular_tube_settings(2, 10, 0.2, 24, 4);
    change(settings);
    try {
      sweep(settings);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message([](SweepSettings& s) { s.wall_thickness = -0.1; }),
            "mesh.swept.wall_thickness: -0.1: must be positive");
  EXPECT_EQ(message([](SweepSettings& s) { s.disc.around = 13; }), "mesh: around is 13: must be even and at least 8");
  EXPECT_NE(message([](SweepSettings& s) { s.angle_origin = {0, 0.1, 1}; }).find("nearly parallel"), std::string::npos);
  EXPECT_NE(message([](SweepSettings& s) { s.sections.pop_back(); }).find("at least two"), std::string::npos);
  EXPECT_NE(message([](SweepSettings& s) {
              s.disc.boundary_layers = 9;
              s.disc.boundary_layer_ratio = 1;
            }).find("core"),
            std::string::npos);
  EXPECT_NE(message([](SweepSettings& s) { s.sections[1].row(0).array() += 9; }).find("accepted"),
            std::string::npos);  // oblique, yet fine
  EXPECT_NE(message([](SweepSettings& s) {
              s.sections[0].col(5) *= 0.1;
              s.sections[0].col(6) = -s.sections[0].col(5);
            }).find("star-shaped"),
            std::string::npos);
  EXPECT_NE(message([](SweepSettings& s) { s.sections[0](2, 7) += 0.5; }).find("off the section's plane"),
            std::string::npos);
}

}  // namespace sweep_test
}  // namespace tether
