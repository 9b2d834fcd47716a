#include "observation_manager/measurements/contour_series.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "tests/observation_manager/lumens.hpp"
#include "tests/solid/report.hpp"

namespace tether::testing {
namespace contour_series_test {

constexpr double pi = std::numbers::pi;

SlicePlane plane(const Vec3& origin, const Vec3& normal) {
  const Vec3 n = normal.normalized(), e1 = (Vec3::UnitX() - n[0] * n).normalized();
  return {origin, e1, n.cross(e1), n};
}

/// A circle of the plane, counterclockwise, from angle `from` on; an arc unless it goes around.
Contour circle(const Vec2& centre, double radius, int points, double from = 0, double turn = 2 * pi) {
  const bool closed = turn == 2 * pi;
  Eigen::Matrix2Xd x(2, points);
  for (int i = 0; i < points; ++i) {
    const double angle = from + turn * i / (closed ? points : points - 1);
    x.col(i) = centre + radius * Vec2(std::cos(angle), std::sin(angle));
  }
  return {x, closed};
}

TriangleSurface cylinder(int around = 96) {
  return tube(around, around / 2, 4, [](double) { return 1.0; });
}

ContourSeries series(const TriangleSurface& model, const SlicePlane& at, std::vector<double> times,
                     std::vector<Contour> contours, int samples = 40) {
  const LumenSurface surface = lumen(model);
  return {settings_for(surface), {{"slice 1", at, std::move(times), std::move(contours)}}, samples, surface};
}

TEST(PlaneCut, GoesAroundTheLumenCounterclockwise) {
  const TriangleSurface model = cylinder();
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0.3, -0.4, 0.8), Vec3(-0.5, 0.2, -0.7)}) {
    const SlicePlane slice = plane(Vec3(0, 0, 2.013), normal);
    const std::vector<CutPiece> pieces = cut_by_plane(model.points, model.triangles, slice);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_TRUE(pieces[0].closed);
    Eigen::Matrix2Xd flat(2, pieces[0].points.cols());
    for (Eigen::Index i = 0; i < flat.cols(); ++i) flat.col(i) = slice.flat(pieces[0].points.col(i));
    // The plane section of a cylinder is an ellipse of area pi / cos.
    EXPECT_NEAR(Contour(flat, true).signed_area(), pi / std::abs(slice.normal[2]), 5e-3);
    EXPECT_LT((slice.normal.transpose() * (pieces[0].points.colwise() - slice.origin)).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(PlaneCut, ThroughNodesIsClosedToo) {
  const TriangleSurface model = cylinder(16);
  const std::vector<CutPiece> pieces = cut_by_plane(model.points, model.triangles, plane(Vec3(0, 0, 2), Vec3(0, 0, 1)));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(pieces[0].closed);
}

TEST(PlaneCut, AlongTheAxisHasTwoOpenPieces) {
  const TriangleSurface model = cylinder(16);
  const std::vector<CutPiece> pieces =
      cut_by_plane(model.points, model.triangles, plane(Vec3(0, 0.05, 0), Vec3(0.01, 1, 0)));
  ASSERT_EQ(pieces.size(), 2U);
  for (const CutPiece& piece : pieces) EXPECT_FALSE(piece.closed);
}

TEST(ContourSeries, OfACylinderSeesTheRadius) {
  const ContourSeries data =
      series(cylinder(), plane(Vec3(0, 0, 2.01), Vec3(0, 0, 1)), {0}, {circle({0, 0}, 1.2, 720)});
  const std::vector<Sample> samples = data.observe(cylinder().points, data.frames()[0]);
  ASSERT_EQ(samples.size(), 40U);
  double weight = 0;
  for (const Sample& s : samples) {
    EXPECT_NEAR(s.distance, 0.2, 1e-3);  // chords of the model: 1 - cos(pi/96)
    EXPECT_NEAR(s.normal.dot(s.position.normalized()),
                s.normal.norm() * s.position.head<2>().norm() / s.position.norm(), 1e-3);
    EXPECT_NEAR(s.normal[2], 0, 1e-14);
    EXPECT_NEAR(s.shares.sum(), 1, 1e-14);
    weight += s.weight;
    Vec3 carried = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
      carried += s.shares[static_cast<Eigen::Index>(i)] * cylinder().points.col(s.nodes[i]);
    EXPECT_LT((carried - s.position).norm(), 1e-14);
  }
  EXPECT_NEAR(weight, 2 * pi * 1.2, 1e-3);
}

TEST(ContourSeries, OfADisplacedCylinderHasTheClosedFormAndConverges) {
  const Vec2 shift(0.15, -0.1);
  std::vector<double> errors;
  for (const int around : {32, 64, 128}) {
    const ContourSeries data =
        series(cylinder(around), plane(Vec3(0, 0, 2.01), Vec3(0, 0, 1)), {0}, {circle(shift, 1.1, 4 * around)});
    errors.push_back(0);
    for (const Sample& s : data.observe(cylinder(around).points, data.frames()[0]))
      errors.back() = std::max(errors.back(), std::abs(s.distance - (1.1 - (s.position.head<2>() - shift).norm())));
  }
  report("distance in a slice of a displaced cylinder, largest error, triangles around", std::array{32, 64, 128},
         errors);
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.3);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.3);
}

TEST(ContourSeries, InATiltedPlaneComparesEllipses) {
  const Vec3 normal = Vec3(0.4, 0, 1).normalized();
  const SlicePlane slice = plane(Vec3(0, 0, 2), normal);
  const double stretch = 1 / normal[2];
  Eigen::Matrix2Xd ellipse(2, 2000);
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2 * pi * i / 2000;
    ellipse.col(i) << 1.1 * stretch * std::cos(angle), 1.1 * std::sin(angle);
  }
  const ContourSeries data = series(cylinder(192), slice, {0}, {Contour(ellipse, true)});
  for (const Sample& s : data.observe(cylinder(192).points, data.frames()[0])) {
    double nearest = 1e9;  // by trying all places of the ellipse
    for (int i = 0; i < 20000; ++i) {
      const double angle = 2 * pi * i / 20000;
      nearest = std::min(
          nearest, (slice.flat(s.position) - Vec2(1.1 * stretch * std::cos(angle), 1.1 * std::sin(angle))).norm());
    }
    EXPECT_NEAR(s.distance, nearest, 1e-5);
    EXPECT_NEAR(s.normal.dot(normal), 0, 1e-14);
  }
}

TEST(ContourSeries, DoesNotSeeMotionThroughThePlane) {
  const ContourSeries data =
      series(cylinder(), plane(Vec3(0, 0, 2.01), Vec3(0, 0, 1)), {0}, {circle({0, 0}, 1.1, 720)});
  Points moved = cylinder().points;
  moved.row(2).array() += 0.5;
  for (const Sample& s : data.observe(moved, data.frames()[0])) EXPECT_NEAR(s.distance, 0.1, 1e-3);
}

TEST(ContourSeries, SeesAConeMoveByItsSlope) {
  const TriangleSurface cone = tube(128, 64, 4, [](double z) { return 1 + 0.2 * z; });
  const ContourSeries data = series(cone, plane(Vec3(0, 0, 2), Vec3(0, 0, 1)), {0}, {circle({0, 0}, 1.4, 720)});
  for (const double by : {-0.5, 0.0, 0.37}) {
    Points moved = cone.points;
    moved.row(2).array() += by;
    for (const Sample& s : data.observe(moved, data.frames()[0])) EXPECT_NEAR(s.distance, 0.2 * by, 1e-3);
  }
}

TEST(ContourSeries, InterpolatesInTimeAndKeepsItsLayout) {
  const ContourSeries data = series(cylinder(), plane(Vec3(0, 0, 2.01), Vec3(0, 0, 1)), {0.1, 0.3},
                                    {circle({0, 0}, 1.1, 720), circle({0, 0}, 1.3, 100)});
  const std::vector<Sample> early = data.observe(cylinder().points, 0.0), at = data.observe(cylinder().points, 0.15);
  ASSERT_EQ(early.size(), at.size());
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_EQ(early[i].excluded, Exclusion::no_frame);
    EXPECT_NEAR(at[i].distance, 0.15, 1.5e-3);
  }
}

TEST(ContourSeries, MovesItsSamplesContinuouslyAcrossNodes) {
  const ContourSeries data =
      series(cylinder(32), plane(Vec3(0, 0, 2), Vec3(0.1, 0.2, 1)), {0}, {circle({0, 0}, 1.1, 720)});
  Points x = cylinder(32).points, last_positions;
  for (int step = 0; step <= 200; ++step) {
    const std::vector<Sample> samples = data.observe(x, data.frames()[0]);
    Points positions(3, static_cast<Eigen::Index>(samples.size()));
    for (std::size_t i = 0; i < samples.size(); ++i) positions.col(static_cast<Eigen::Index>(i)) = samples[i].position;
    if (step > 0) {
      EXPECT_LT((positions - last_positions).colwise().norm().maxCoeff(), 3e-3) << step;
    }
    last_positions = positions;
    x.row(2).array() += 1e-3;  // two rows of nodes pass
    x.row(0).array() += 2e-4;
  }
}

TEST(ContourSeries, OfAnArcObservesOnlyBesideIt) {
  for (const bool clockwise : {false, true}) {
    Contour arc = circle({0, 0}, 1.1, 90, 0.5, 1.5);
    if (clockwise) arc = arc.reversed();
    const ContourSeries data = series(cylinder(), plane(Vec3(0, 0, 2.01), Vec3(0, 0, 1)), {0}, {arc}, 100);
    int observed = 0, beside = 0, away = 0;
    double length = 0;
    for (const Sample& s : data.observe(cylinder().points, data.frames()[0])) {
      const double angle = std::atan2(s.position[1], s.position[0]);
      if (angle > 0.55 && angle < 1.95) {
        EXPECT_NEAR(s.distance, 0.1, 1e-3);
        ++beside;
      } else if (angle < 0.45 || angle > 2.05) {
        EXPECT_EQ(s.excluded, Exclusion::rim);
        ++away;
      }
      observed += s.weight > 0 ? 1 : 0;
      length += s.weight;
    }
    EXPECT_NEAR(beside, 100 * 1.4 / (2 * pi), 1);
    EXPECT_NEAR(away, 100 * (1 - 1.6 / (2 * pi)), 1);
    EXPECT_NEAR(observed, 100 * 1.5 / (2 * pi), 2);
    EXPECT_NEAR(length, 1.5, 2 * 2 * pi / 100) << "of the lumen beside the arc, to a sample at each end";
  }
}

TEST(ContourSeries, SaysWhenASliceMissesTheModel) {
  const ContourSeries data = series(cylinder(), plane(Vec3(0, 0, 7), Vec3(0, 0, 1)), {0}, {circle({0, 0}, 1.1, 90)});
  ASSERT_EQ(data.notes().size(), 1U);
  EXPECT_EQ(told(data.notes()), std::vector<std::string>{"slice 1: its plane misses the imaged lumen"});
  const std::vector<Sample> samples = data.observe(cylinder().points, data.frames()[0]);
  ASSERT_EQ(samples.size(), 40U);
  for (const Sample& s : samples) {
    EXPECT_EQ(s.excluded, Exclusion::missed);
    EXPECT_EQ(s.weight, 0);
  }
}

/// docs/observations.md, facets and chords: what a model on the very vessel reads as.
TEST(FacetsAndChords, BiasIsThatOfTheDocumentation) {
  for (const int around : {16, 32, 64}) {
    const double h = 2 * pi / around, expected = h * h / 12;
    const TriangleSurface vessel = tube(around, 4, 2, [](double) { return 1.0; });
    const ContourSeries contours =
        series(vessel, plane(Vec3(0, 0, 0.9), Vec3::UnitZ()), {0.0}, {circle(Vec2::Zero(), 1, 2048)}, 512);
    double inward = 0;
    for (const Sample& s : contours.observe(vessel.points, 0.0)) inward += s.distance / 512;
    EXPECT_NEAR(inward / expected, 1, 0.05) << around;

    const SignedSurface data(vessel);
    double outward = 0, most = 0;
    const int nodes = 1000;
    for (int i = 0; i < nodes; ++i) {
      const double angle = 2 * pi * (i + 0.3) / nodes;
      const double d = data.closest(Vec3(std::cos(angle), std::sin(angle), 0.9)).distance;
      outward -= d / nodes, most = std::max(most, -d);
    }
    EXPECT_NEAR(outward / expected, 1, 0.05) << around;
    EXPECT_NEAR(most / (h * h / 8), 1, 0.05) << around;
  }
}

}  // namespace contour_series_test
}  // namespace tether::testing
