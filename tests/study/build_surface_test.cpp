#include <gtest/gtest.h>

#include "common/base/csv.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/centreline/curve.hpp"
#include "vessel/study/build_surface.hpp"
#include "vessel/study/openings.hpp"
#include "vessel/study/read_surface.hpp"
#include "vessel/surface/smooth.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace {

using testing::bent_tube;

StudyCase tube_study(const RawSurface& surface, const std::string& name) {
  StudyCase study;
  study.name = name;
  study.surface = {test_folder() / (name + ".stl"), "cm"};
  testing::write_stl(study.file(), surface);
  study.openings.resize(2);
  study.openings[0] = {"in", {}}, study.openings[0].second.near = {4, 0, 0};
  study.openings[1] = {"out", {}}, study.openings[1].second.near = {-2, 3.46, 0};
  study.inlet = "in";
  study.edges.longest = 0.25;
  return study;
}

TEST(BuildSurface, ABentTubeKeepsItsVolumeLineAndRadius) {
  const BuiltSurface built = build_surface(tube_study(bent_tube(), "bent"));
  const RawSurface given = bent_tube();
  EXPECT_NEAR(built.summary.surface.volume, enclosed_volume(given), 0.01 * enclosed_volume(given));
  EXPECT_TRUE(built.summary.repairs.empty() || built.summary.repairs[0].kind == RepairKind::rims_flattened);
  EXPECT_GT(built.summary.surface.least_angle, 20);
  EXPECT_LT(built.summary.distance.p95, 0.01);  // a hundredth of the radius: chords of 32 corners are half that off
  const Branch& line = built.tree.branches.at(0);
  EXPECT_NEAR(arc_lengths(line.points).back(), testing::bend_radius * testing::bend_angle, 0.05);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    EXPECT_NEAR(line.points[i].head<2>().norm(), testing::bend_radius, 0.05) << i;
    EXPECT_NEAR(line.points[i].z(), 0, 0.05) << i;
    EXPECT_NEAR(line.radii[i], testing::tube_radius, 0.05) << i;
  }
}

TEST(BuildSurface, CapsAreFlatAndFaceOutward) {
  const BuiltSurface built = build_surface(tube_study(bent_tube(), "caps"));
  ASSERT_EQ(built.summary.openings.size(), 2U);
  EXPECT_GT(built.summary.openings[0].outward.dot(-Vec3::UnitY()), 0.999);
  for (int k = 1; k <= 2; ++k)
    for (std::size_t t = 0; t < built.surface.triangles.size(); ++t)
      if (built.surface.label[t] == k) {
        const BuiltOpening& cap = built.summary.openings[k - 1];
        for (const int n : built.surface.triangles[t])
          EXPECT_NEAR((built.surface.points.col(n) - cap.centre).dot(cap.outward), 0, 1e-6);
      }
}

TEST(BuildSurface, FlatEndsOfAClosedSurfaceAreFound) {
  RawSurface closed = bent_tube();
  for (const Rim& rim : rims_of(closed)) fill(closed, rim, 0);
  const BuiltSurface built = build_surface(tube_study(closed, "closed"));
  ASSERT_FALSE(built.summary.repairs.empty());
  EXPECT_EQ(built.summary.repairs[0].kind, RepairKind::caps_found);
  EXPECT_EQ(built.summary.repairs[0].count, 2);
}

TEST(BuildSurface, PlanesAndDistancesCutTheEnds) {
  StudyCase study = tube_study(bent_tube(), "cut");
  const Vec3 at = testing::tube_middle(0.75), along(-at.y(), at.x(), 0);
  study.openings[1].second.near.clear();
  study.openings[1].second.cut.emplace();
  study.openings[1].second.cut->point = at, study.openings[1].second.cut->outward = along;
  study.openings[0].second.trim = 1;
  const BuiltSurface built = build_surface(study);
  const double left = 0.75 * testing::bend_angle * testing::bend_radius - 1;
  EXPECT_NEAR(arc_lengths(built.tree.branches[0].points).back(), left, 0.08);
  EXPECT_NEAR(built.summary.surface.volume, std::numbers::pi * left, 0.03 * std::numbers::pi * left);
}

TEST(BuildSurface, SmoothingTakesNoiseAndKeepsTheVolume) {
  RawSurface tube = bent_tube();
  for (Eigen::Index i = 32; i + 32 < tube.points.cols(); ++i)
    tube.points.col(i) += 0.02 * Vec3(std::sin(7.0 * i), std::sin(11.0 * i), std::sin(13.0 * i));
  const auto roughness = [](const RawSurface& s) {
    double sum = 0;
    for (Eigen::Index i = 0; i < s.points.cols(); ++i) {
      const Vec3 x = s.points.col(i);
      const double off = std::hypot(x.head<2>().norm() - testing::bend_radius, x.z()) - testing::tube_radius;
      sum += off * off / static_cast<double>(s.points.cols());
    }
    return std::sqrt(sum);
  };
  const double before = roughness(tube);
  const double noisy = enclosed_volume(tube), change = smooth(tube, 20);
  EXPECT_LT(roughness(tube), 0.6 * before);
  EXPECT_LT(std::abs(change), 0.005);
  EXPECT_NEAR(enclosed_volume(tube) / noisy - 1, change, 1e-12);
}

const std::filesystem::path arch_data = TETHER_SOURCE "/data/aortic_arch_adult";

StudyCase arch_study() {
  StudyCase study;
  study.name = "arch";
  study.surface = {arch_data / "arch_surface.vtp", "mm"};
  for (const char* name : {"ascending", "brachiocephalic", "left_carotid", "left_subclavian", "descending"}) {
    study.openings.emplace_back(name, OpeningCase{});
    study.openings.back().second.label = static_cast<int>(study.openings.size());
  }
  study.inlet = "ascending", study.trunk = "descending";
  return study;
}

/// Edges by the radius leave borders of parts, and slivers beside them; caps were triangulated by chance.
TEST(BuildSurface, ACoarseArchIsTheSameEachTimeAndHasNoSlivers) {
  StudyCase study = arch_study();
  study.edges.per_radius = 0.55, study.edges.shortest = 0.35, study.edges.longest = 0.75;
  const LabelledSurface first = build_surface(study).surface, second = build_surface(study).surface;
  ASSERT_EQ(first.points.cols(), second.points.cols());
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.triangles, second.triangles);
  for (const Triangle& t : first.triangles) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (first.points.col(t[k]) - first.points.col(t[(k + 1) % 3])).norm());
    const double height = 2 * area_vector(first.points, t).norm() / longest;
    EXPECT_GT(height, longest / 12) << first.points.col(t[0]).transpose();  // a cap of 160 degrees
  }
}

/// Passes of remeshing, each onto the facets of the one before, made the aorta 0.1 mm narrower.
TEST(BuildSurface, NoNodeOfACoarseArchLiesInsideTheSurfaceGiven) {
  StudyCase study = arch_study();
  study.edges.per_radius = 0.5, study.edges.shortest = 0.3, study.edges.longest = 0.6;
  const LabelledSurface coarse = build_surface(study).surface;
  std::vector<bool> of_wall(static_cast<std::size_t>(coarse.points.cols()), true);
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t)
    if (coarse.label[t] != 0)
      for (const int node : coarse.triangles[t]) of_wall[static_cast<std::size_t>(node)] = false;
  const RawSurface given = read_surface({(arch_data / "arch_surface.vtp").string(), "mm"});
  const SignedSurface wall({given.points, given.triangles});
  int asked = 0;
  for (Eigen::Index node = 0; node < coarse.points.cols(); ++node) {
    if (!of_wall[static_cast<std::size_t>(node)]) continue;
    const Vec3 x = coarse.points.col(node);
    EXPECT_LT(wall.closest(x).distance, 1e-5) << x.transpose();  // single precision at 40 cm
    ++asked;
  }
  EXPECT_GT(asked, 1000);
}

TEST(BuildSurface, ABranchingArchHasATreeNearItsAuthors) {
  const BuiltSurface built = build_surface(arch_study());
  ASSERT_EQ(built.tree.branches.size(), 4U);
  EXPECT_EQ(built.tree.branches[0].name, "descending");
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(built.tree.branches[i].parent, 0);
  EXPECT_NEAR(built.summary.surface.volume, 161.7, 1.6);
  const CsvTable table(arch_data / "centreline.csv");
  const std::vector<std::string> branch = table.names("branch");
  const std::vector<double> x = table.numbers("x_mm"), y = table.numbers("y_mm"), z = table.numbers("z_mm"),
                            radius = table.numbers("radius_mm");
  double off = 0, wide = 0, count = 0;
  for (std::size_t i = 0; i < branch.size(); ++i) {
    if (branch[i] != "aorta") continue;
    const Branch& trunk = built.tree.branches[0];
    const Vec3 at = 0.1 * Vec3(x[i], y[i], z[i]);
    off += nearest_on(trunk.points, at).distance, ++count;
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < trunk.points.size(); ++k)
      if ((trunk.points[k] - at).norm() < (trunk.points[nearest] - at).norm()) nearest = k;
    wide += std::abs(trunk.radii[nearest] - 0.1 * radius[i]);
  }
  EXPECT_LT(off / count, 0.12);  // [cm], of a radius of 1.2
  EXPECT_LT(wide / count, 0.1);  // [cm]
}

}  // namespace
}  // namespace tether
