// A ring that the heart carries along: poses from points, the motion in time, and a wall driven by it.
#include "solid/motions/rigid_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "solid/motion_case.hpp"
#include "solid/solid_solver.hpp"
#include "tests/solid/walls.hpp"

namespace tether {
namespace rigid_motion_test {

constexpr double pi = std::numbers::pi, period = 0.8;

/// A ring of radius 1 in a plane, about a centre.
Points ring_at(const Vec3& centre, int count = 12) {
  Points ring(3, count);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    ring.col(i) = centre + Vec3(std::cos(angle), std::sin(angle), 0);
  }
  return ring;
}

Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

struct Turning {
  Vec3 start{1, 2, 3}, axis{1, 2, -1};
  Vec3 centre(double t) const { return start + Vec3(0.3, -0.2, -1) * (1 - std::cos(2 * pi * t / period)); }
  Mat3 turned(double t) const { return rotation(0.3 * std::sin(2 * pi * t / period), axis); }
  Points marks(double t) const { return (turned(t) * (ring_at(start).colwise() - start)).colwise() + centre(t); }
  Vec3 displaced(const Vec3& x, double t) const { return turned(t) * (x - start) + centre(t) - x; }
};

std::vector<double> frames(int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(period * i / count);
  return times;
}

Poses measured(const Turning& body, int count) {
  std::vector<Points> marks;
  for (const double time : frames(count)) marks.push_back(body.marks(time));
  return poses_of(frames(count), marks);
}

TEST(PosesOfPoints, AreThoseOfTheBodyEvenInAPlane) {
  const Turning body;
  const Poses poses = measured(body, 10);
  EXPECT_LT(poses.misfit, 1e-14);
  for (Eigen::Index k = 0; k < 10; ++k) {
    const double time = poses.times[static_cast<std::size_t>(k)];
    EXPECT_LT((poses.centres.col(k) - body.centre(time)).norm(), 1e-14);
    const Vec3 turn = 0.3 * std::sin(2 * pi * time / period) * body.axis.normalized();
    EXPECT_LT((poses.turns.col(k) - turn).norm(), 1e-13);
  }
}

TEST(PosesOfPoints, TellHowFarThePointsAreFromARigidBody) {
  std::vector<Points> marks{ring_at(Vec3::Zero()), 1.2 * ring_at(Vec3::Zero())};
  EXPECT_NEAR(poses_of({0, 1}, marks).misfit, 0.2 / std::sqrt(2.0), 1e-14) << "it grows: no rigid motion";
}

TEST(PosesOfPoints, OnALineCannotBeTold) {
  Points line(3, 3);
  line << 0, 1, 2, 0, 2, 4, 0, -1, -2;
  EXPECT_THROW(poses_of({0}, {line}), InputError);
}

TEST(RigidMotion, IsThatOfTheBodyBetweenTheFrames) {
  const Turning body;
  const RigidMotion motion(measured(body, 25), {.period = period, .harmonics = 2});
  EXPECT_LT(motion(0).at(Vec3(3, -1, 2)).norm(), 1e-14);
  for (double time = 0; time < 3 * period; time += 0.037) {
    const Vec3 x(3, -1, 2);
    EXPECT_LT((motion(time).at(x) - body.displaced(x, time)).norm(), 1e-12);
  }
  EXPECT_NEAR(motion.largest_way(), 2 * Vec3(0.3, -0.2, -1).norm(), 0.01);
}

TEST(RigidMotion, WithoutTurnsCarriesAllPointsAlike) {
  const Turning body;
  const RigidMotion motion(measured(body, 25), {.period = period, .harmonics = 2, .turns = false});
  EXPECT_LT((motion(0.3).at(Vec3(9, 9, 9)) - (body.centre(0.3) - body.start)).norm(), 1e-12);
}

/// The same motion seen from another frame, about a ring that is elsewhere.
TEST(RigidMotion, IsPlacedByARotationAndTheRingsCentre) {
  const Turning body;
  const Mat3 Q = rotation(1.1, {1, -1, 2});
  const Vec3 centre(5, 5, 5);
  const RigidMotion placed(measured(body, 25), {.period = period, .harmonics = 2}, {Q, centre});
  const double time = 0.2;
  const Vec3 arm(0.4, -0.3, 0.7);
  const Vec3 expected = Q * body.displaced(body.start + Q.transpose() * arm, time);
  EXPECT_LT((placed(time).at(centre + arm) - expected).norm(), 1e-12);
}

TEST(RigidMotion, RefusesPointsThatTurnTooFar) {
  const Points ring = ring_at(Vec3::Zero());
  const std::vector<Points> marks{ring, rotation(2.0, Vec3::UnitZ()) * ring};
  const Poses poses = poses_of({0, 1}, marks);
  EXPECT_THROW(RigidMotion(poses, MotionShape{}), InputError);
  EXPECT_NO_THROW(RigidMotion(poses, MotionShape{std::nullopt, std::nullopt, false}));
}

/// The ring of a real aortic valve: our fit of its points against the one published with them (SOURCE.md), which used
/// two harmonics for the turns and three for the centre.
TEST(RigidMotion, OfARealValveIsThePublishedFit) {
  const std::filesystem::path data = std::filesystem::path(TETHER_SOURCE) / "data/heart_motion_patient1";
  MotionCase given;
  given.file = data / "ring_points.csv";
  given.table = "points";
  given.clock = "phase";
  given.time = "phase";
  given.x = "x_mm", given.y = "y_mm", given.z = "z_mm", given.unit = "mm";
  given.period = period;
  given.harmonics = 3;
  const UnitSystem units = UnitSystem::cgs();
  const RigidMotion motion = given.load(units, {}, Points(3, 0));
  const CsvTable published(data / "ring_motion_smooth.csv");
  const auto x = published.numbers("centroid_x_mm"), y = published.numbers("centroid_y_mm"),
             z = published.numbers("centroid_z_mm"), phase = published.numbers("phase");
  const Vec3 start = Vec3(x[0], y[0], z[0]) / 10;
  double worst = 0;
  for (std::size_t k = 0; k < phase.size(); ++k) {
    const Vec3 there = Vec3(x[k], y[k], z[k]) / 10;
    worst = std::max(worst, (motion(phase[k] * period).at(start) - (there - start)).norm());
  }
  EXPECT_LT(worst, 0.05) << "half a millimetre";
  EXPECT_NEAR(motion.largest_way(), 1.38, 0.05) << "13.8 mm";
  EXPECT_NEAR(motion.centre_residual(), 0.15, 0.05);
}

/// A thin plate whose ends both follow one rigid motion, slowly: all of it does, and the ends exactly.
struct DrivenPlate {
  DrivenPlate() : wall(plate({3, 1, 0.2}, {6, 2}, 1)), model(wall, settings(), wall.points, ends(), {}), solver(model) {
    std::vector<DrivenRing> rings;
    for (const Patch& ring : wall.rings) rings.push_back({ring.name, nodes_of(ring.triangles), {motion}});
    model.drive(std::move(rings));
  }
  static WallSettings settings() { return {.material = "neo_hookean", .material_values = {1e6, 0.3}, .density = 1.0}; }
  std::vector<int> ends() const {
    std::vector<int> nodes = nodes_of(wall.rings[0].triangles);
    for (const int node : nodes_of(wall.rings[1].triangles)) nodes.push_back(node);
    return nodes;
  }
  void step(double dt) {
    solver.begin_step(time, dt);
    solver.evaluate(Points::Zero(3, wall.interface_nodes));
    solver.accept();
    time += dt;
  }
  Vec3 displaced(int node) const { return motion(time).at(wall.points.col(node)); }

  TissueMotion motion = [](double t) {
    const Mat3 turned = rotation(0.4 * t, {1, 2, 3});
    return AffineDisplacement{Vec3(0.5 * t, -0.2 * t, t * t), turned - Mat3::Identity()};
  };
  WallMesh wall;
  WallModel model;
  SolidSolver solver;
  double time = 0;
};

TEST(ADrivenRing, IsWhereTheMotionSaysWhateverTheSteps) {
  DrivenPlate plate;
  for (const double dt : {0.01, 0.01, 0.005, 0.02, 0.01, 0.01}) {
    plate.step(dt);
    for (const int node : plate.ends())
      EXPECT_LT((plate.solver.displacement().col(node) - plate.displaced(node)).norm(), 1e-14);
  }
}

TEST(ADrivenRing, CarriesTheWallAlongWithoutRinging) {
  DrivenPlate plate;
  const double dt = 0.01;
  double worst = 0;
  for (int k = 0; k < 100; ++k) {
    plate.step(dt);
    for (Eigen::Index node = 0; node < plate.wall.points.cols(); ++node)
      worst = std::max(worst, (plate.solver.displacement().col(node) - plate.displaced(static_cast<int>(node))).norm());
  }
  EXPECT_LT(worst, 5e-3) << "the wall starts at rest and swings a little about the motion, which goes far";
  EXPECT_GT(plate.solver.largest_displacement(), 1.0);
}

}  // namespace rigid_motion_test
}  // namespace tether
