// The surface through contours: where it runs, its ends, and what is refused.
#include "vessel/study/loft.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/centreline/curve.hpp"
#include "vessel/study/build_surface.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace loft_test {

using namespace tether::testing;

/// Round sections of the bent tube, `sections` of them, in mm.
std::filesystem::path tube_contours(int sections) {
  const auto file = test_folder() / "contours.csv";
  std::ofstream out(file);
  out << "section,point,x,y,z\n";
  constexpr int points = 40;
  for (int k = 0; k < sections; ++k) {
    const Vec3 middle = tube_middle(double(k) / std::max(sections - 1, 1));
    for (int i = 0; i < points; ++i) {
      const double angle = 2 * std::numbers::pi * i / points;
      const Vec3 x =
          10 * (middle + tube_radius * (std::cos(angle) * middle.normalized() + std::sin(angle) * Vec3::UnitZ()));
      out << 'S' << k << ',' << i << ',' << x[0] << ',' << x[1] << ',' << x[2] << '\n';
    }
  }
  return file;
}

LoftCase loft_of(const std::filesystem::path& file, double extend = 0) {
  LoftCase given;
  given.file = file, given.unit = "mm", given.extend = {extend, extend};
  return given;
}

double error_of_volume(int sections) {
  const RawSurface surface = surface_through(loft_of(tube_contours(sections)), "contours");
  return std::abs(enclosed_volume(surface) / tube_volume() - 1);
}

/// Between contours it is a cubic with slopes by parabolas: the error falls with the third power of their distance,
/// down to that of the facets (0.1 %, 40 corners in each contour).
TEST(Loft, FollowsABentTubeBetweenItsContours) {
  EXPECT_LT(error_of_volume(7), 5e-3);
  EXPECT_GT(error_of_volume(4) / error_of_volume(7), 5);
}

TEST(Loft, HasAWallAndTwoFlatEndsThatFaceOutward) {
  const RawSurface surface = surface_through(loft_of(tube_contours(7), 1.5), "contours");
  EXPECT_GT(enclosed_volume(surface), 0);
  const auto end_of = [&](int face) {
    std::pair<double, Vec3> found{0, Vec3::Zero()};  // area, outward
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (surface.face_id[t] == face) {
        const Vec3 area = area_vector(surface.points, surface.triangles[t]);
        found.first += area.norm(), found.second += area;
      }
    return found;
  };
  for (const int face : {1, 2}) {
    const auto [area, outward] = end_of(face);
    // an extension goes on along the last chord, 10 degrees off the section's normal, and is cut across it
    EXPECT_NEAR(area, std::numbers::pi * tube_radius * tube_radius * std::cos(bend_angle / 12), 5e-3) << face;
    EXPECT_NEAR(outward.norm(), area, 1e-9) << "flat";
    const Vec3 along = face == 1 ? Vec3(0, -1, 0) : Vec3(-std::sin(bend_angle), std::cos(bend_angle), 0);
    EXPECT_GT(outward.normalized().dot(along), 0.98) << face;
  }
  EXPECT_NEAR(enclosed_volume(surface), tube_volume() + 2 * 1.5 * std::numbers::pi, 0.02 * tube_volume());
}

TEST(Loft, BecomesALumenWithNamedEnds) {
  StudyCase study;
  study.name = "lofted";
  study.contours = loft_of(tube_contours(7));
  study.openings.resize(2);
  study.openings[0] = {"in", {}}, study.openings[0].second.label = 1;
  study.openings[1] = {"out", {}}, study.openings[1].second.label = 2;
  study.inlet = "in";
  study.edges.longest = 0.25;
  const BuiltSurface built = build_surface(study);
  EXPECT_NEAR(built.summary.surface.volume, tube_volume(), 0.02 * tube_volume());
  EXPECT_NEAR(arc_lengths(built.tree.branches.at(0).points).back(), bend_radius * bend_angle, 0.1);
  EXPECT_LT((built.summary.openings[0].centre - tube_middle(0)).norm(), 0.05);
  EXPECT_LT((built.summary.openings[1].centre - tube_middle(1)).norm(), 0.05);
  study.contours->unit = "m";
  try {
    build_surface(study);
    FAIL() << "a vessel 20 m wide";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean mm"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("contours.any_size"), std::string::npos) << error.what();
  }
}

TEST(Loft, SaysWhichFieldAndSectionIsWrong) {
  const auto refusal_of = [](const LoftCase& given) -> std::string {
    try {
      surface_through(given, "study.yaml:2: contours");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal_of(loft_of(tube_contours(1))).find("study.yaml:2: contours: 1 cross-sections: at least two"),
            std::string::npos);
  const auto swapped = test_folder() / "swapped.csv";
  std::ofstream in_disorder(swapped);
  in_disorder << "section,point,x,y,z\n";
  for (const int at : {0, 2, 1, 3})
    for (int i = 0; i < 12; ++i) {
      const double angle = 2 * std::numbers::pi * i / 12;
      in_disorder << at << ',' << i << ',' << 10 * std::cos(angle) << ',' << 10 * std::sin(angle) << ',' << 30 * at
                  << '\n';
    }
  in_disorder.close();
  EXPECT_EQ(refusal_of(loft_of(swapped)),
            "study.yaml:2: contours: contour 3 lies back toward contour 1: they must stand in order along the vessel");
  const auto file = test_folder() / "oblique.csv";
  std::ofstream out(file);
  out << "section,point,x,y,z\n";
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 12; ++i) {
      const double angle = 2 * std::numbers::pi * i / 12;
      out << k << ',' << i << ',' << 10 * std::cos(angle) << ',' << 10 * std::sin(angle) << ','
          << 60 * k + 10 * std::cos(angle) << '\n';
    }
  out.close();
  EXPECT_NE(refusal_of(loft_of(file, 0.2)).find("study.yaml:2: contours.extend.inlet: 0.2 is too short"),
            std::string::npos)
      << refusal_of(loft_of(file, 0.2));
  EXPECT_EQ(refusal_of(loft_of(file, 3)), "");
}

}  // namespace loft_test
}  // namespace tether
