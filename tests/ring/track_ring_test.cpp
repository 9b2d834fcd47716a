// The ring of an opening through frames that were made by a rigid motion.
#include "vessel/ring/track_ring.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/ring/ring_text.hpp"
#include "vessel/surface/rims.hpp"

namespace tether {
namespace track_ring_test {

namespace fs = std::filesystem;

const Vec3 inlet(4, 0, 0), arm(0.3, 0.4, 1);  // the ring's middle; a landmark from there

Mat3 rotation(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// The whole tube, turned about its inlet's middle and shifted.
struct Pose {
  Vec3 shift;
  double angle;
  Vec3 axis;
};

class TrackRing : public ::testing::Test {
 protected:
  void frame(double time, const Pose& pose, bool closed = false) {
    RawSurface tube = testing::bent_tube();
    if (closed)
      for (const Rim& rim : rims_of(tube)) fill(tube, rim, 1);
    const Mat3 turned = rotation(pose.angle, pose.axis);
    tube.points = (turned * (tube.points.colwise() - inlet)).colwise() + (inlet + pose.shift);
    const std::string file = "frame_" + std::to_string(count_++) + ".stl";
    testing::write_stl(folder / file, tube);
    table_ += fmt::format("{}, {}\n", file, time);
    const Vec3 mark = inlet + pose.shift + turned * arm;
    landmarks_ += fmt::format("{}, {}, {}, {}\n", time, mark[0], mark[1], mark[2]);
  }
  RingTrackCase asked(bool with_landmark) const {
    std::ofstream(folder / "frames.csv") << table_;
    std::ofstream(folder / "landmark.csv") << landmarks_;
    RingTrackCase result;
    result.name = "root";
    result.frames.file = folder / "frames.csv";
    result.frames.unit = "cm";
    result.ring.near = {4.2, 0, 0};
    if (with_landmark) {
      result.landmark.emplace();
      result.landmark->file = folder / "landmark.csv";
    }
    return result;
  }
  std::string fault(const RingTrackCase& what) const {
    try {
      track_ring(what);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  TemporaryFolder folder;

 private:
  int count_ = 0;
  std::string table_ = "file, time [s]\n", landmarks_ = "time [s], x [cm], y, z\n";
};

TEST_F(TrackRing, IsTheMotionOfTheBodyIfALandmarkTellsTheTurn) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0.2, -0.5, 1}, 0.3, {1, 2, 3}});
  frame(0.8, {{0.1, -0.9, 1.5}, 0.4, {0, 1, 0}});
  const TrackedRing ring = track_ring(asked(true));
  ASSERT_EQ(ring.poses.size(), 3u);
  EXPECT_LT((ring.poses[0].centre - inlet).norm(), 1e-6);
  EXPECT_LT((ring.poses[0].normal + Vec3::UnitY()).norm(), 1e-6) << "out of the vessel";
  EXPECT_LT((ring.poses[1].centre - inlet - Vec3(0.2, -0.5, 1)).norm(), 1e-6);
  EXPECT_LT((ring.poses[1].turn - 0.3 * Vec3(1, 2, 3).normalized()).norm(), 1e-6);
  EXPECT_LT((ring.poses[2].turn - 0.4 * Vec3::UnitY()).norm(), 1e-6) << "about its own axis";
  EXPECT_NEAR(ring.largest_way, Vec3(0.1, -0.9, 1.5).norm(), 1e-6);
  EXPECT_NEAR(ring.poses[1].radius, 1, 0.01);
  EXPECT_TRUE(ring.turns_about_axis);
}

TEST_F(TrackRing, WithoutALandmarkItTiltsAndDoesNotTurnAboutItsAxis) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0, -0.5, 0}, 0.4, Vec3::UnitY()});
  frame(0.8, {{0, -0.5, 0}, 0.4, Vec3::UnitX()});
  const TrackedRing ring = track_ring(asked(false));
  EXPECT_LT(ring.poses[1].turn.norm(), 1e-6);
  EXPECT_LT((ring.poses[2].turn - 0.4 * Vec3::UnitX()).norm(), 1e-6);
  EXPECT_NEAR(ring.largest_tilt, 0.4 * 180 / std::numbers::pi, 1e-4);
  EXPECT_FALSE(ring.turns_about_axis);
}

TEST_F(TrackRing, FindsTheEndsOfClosedSurfaces) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()}, true);
  frame(0.4, {{0, -0.5, 0.2}, 0, Vec3::UnitX()}, true);
  const TrackedRing ring = track_ring(asked(false));
  EXPECT_LT((ring.poses[1].centre - inlet - Vec3(0, -0.5, 0.2)).norm(), 1e-6);
}

TEST_F(TrackRing, WritesATableOfPoses) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0, -0.5, 0}, 0.1, Vec3::UnitX()});
  write_poses(folder / "poses.csv", track_ring(asked(false)));
  const CsvTable table(folder / "poses.csv");
  EXPECT_NEAR(table.quantities("y", UnitSystem::mm_g_s(), dimension::length)[1], -5, 1e-5);
  EXPECT_NEAR(table.numbers("turn_x")[1], 0.1, 1e-6);
}

TEST_F(TrackRing, MistakesNameTheFrame) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0, -5, 0}, 0, Vec3::UnitX()});
  EXPECT_NE(fault(asked(false)).find("frame at 0.4 s"), std::string::npos) << fault(asked(false));
  EXPECT_NE(fault(asked(false)).find("farther than its width"), std::string::npos);
  RingTrackCase labelled = asked(false);
  labelled.ring.label = 7;
  EXPECT_NE(fault(labelled).find("no triangle has the label 7"), std::string::npos) << fault(labelled);
  std::ofstream(folder / "landmark.csv") << "time [s],x,y,z\n0,4,-3,0\n1,4,-3,0\n";
  RingTrackCase on_axis = asked(false);
  on_axis.landmark.emplace();
  on_axis.landmark->file = folder / "landmark.csv";
  std::ofstream(folder / "landmark.csv") << "time [s],x,y,z\n0,4,-3,0\n1,4,-3,0\n";
  EXPECT_NE(fault(on_axis).find("cannot tell a turn"), std::string::npos) << fault(on_axis);
  std::ofstream(folder / "frames.csv") << "file,time [s]\nframe_0.stl,0\nframe_1.stl,0\n";
  RingTrackCase twice = on_axis;
  EXPECT_NE(fault(twice).find("frames.csv:3: the time 0 s of frame_1.stl does not come after 0 s"), std::string::npos)
      << fault(twice);
  std::ofstream(folder / "frames.csv") << "file,time [s]\nlost.stl,0\nframe_1.stl,1\n";
  EXPECT_NE(fault(twice).find("lost.stl"), std::string::npos) << fault(twice);
  std::ofstream(folder / "lines.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 1 2\nf 3 3 4\n";
  std::ofstream(folder / "frames.csv") << "file,time [s]\nlines.obj,0\nframe_1.stl,1\n";
  EXPECT_NE(fault(twice).find("lines.obj: all its triangles are without area"), std::string::npos) << fault(twice);
  std::ofstream(folder / "frames.csv") << "file,time [s]\nframe_0.stl,0\n";
  EXPECT_NE(fault(twice).find("frames.csv: lists 1 frame: a motion needs at least two"), std::string::npos)
      << fault(twice);
}

TEST_F(TrackRing, TimesStandInOrderAndHaveAUnit) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0, -0.5, 0}, 0.1, Vec3::UnitX()});
  RingTrackCase given = asked(true);
  EXPECT_EQ(fault(given), "accepted");
  const auto refused = [&](const std::string& file, const std::string& table, const std::string& message) {
    std::ofstream(folder / file) << table;
    EXPECT_EQ(fault(given), (folder / file).string() + message);
  };
  refused("frames.csv", "file,time [ms]\nframe_0.stl,400\nframe_1.stl,0\n",
          ":3: the time 0 s of frame_1.stl does not come after 0.4 s");
  refused("frames.csv", "file,time\nframe_0.stl,0\nframe_1.stl,0.4\n",
          ":2: the unit of time must stand in its heading, as in time [ms]");
  refused("frames.csv", "file,time [s]\nframe_0.stl,0\nframe_1.stl,+-0.4\n", ":3: time: '+-0.4' is not a number");
  given = asked(true);
  refused("landmark.csv", "time [s],x,y,z\n0.4,4,0,1\n0,4,0,1\n", ":3: the time 0 s does not come after 0.4 s");
  refused("landmark.csv", "time,x,y,z\n0,4,0,1\n0.4,4,0,1\n",
          ":2: the unit of time must stand in its heading, as in time [ms]");
}

/// As a study's surfaces are, by the same limits.
TEST_F(TrackRing, AWrongUnitAndAPlaceFarFromAnyOpeningAreRefused) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0, -0.5, 0}, 0.1, Vec3::UnitX()});
  const std::string in_first = "frame at 0 s, " + (folder / "frame_0.stl").string() + ": ";
  RingTrackCase wide = asked(false);
  wide.frames.unit = "m";
  EXPECT_EQ(fault(wide).rfind(in_first + "its largest opening is ", 0), 0U) << fault(wide);
  EXPECT_NE(fault(wide).find(" cm wide in m, which no vessel is; did you mean cm ("), std::string::npos);
  EXPECT_NE(fault(wide).find("; frames.any_size: true takes it as it is"), std::string::npos) << fault(wide);
  wide.frames.any_size = true, wide.ring.near.clear();
  EXPECT_EQ(fault(wide), "accepted");
  RingTrackCase far = asked(false);
  far.ring.near = {400, 0, 0};
  EXPECT_EQ(fault(far).rfind(in_first + "ring.near: there is no opening near (400, 0, 0) cm: the nearest, at ", 0), 0U)
      << fault(far);
}

TEST_F(TrackRing, ALandmarkIsToldAtTheTimesOfAllFrames) {
  frame(0, {Vec3::Zero(), 0, Vec3::UnitX()});
  frame(0.4, {{0, -0.5, 0}, 0.1, Vec3::UnitX()});
  const RingTrackCase given = asked(true);
  const std::string file = (folder / "landmark.csv").string();
  std::ofstream(folder / "landmark.csv") << "time [s],x,y,z\n0,4.3,0.4,1\n0.39,4.3,0,1\n";
  EXPECT_EQ(fault(given), file +
                              ": tells the landmark from 0 to 0.39 s, not at 0.4 s, where the frame frame_1.stl is: "
                              "must tell all frames");
  std::ofstream(folder / "landmark.csv") << "time [s],x,y,z\n0.01,4.3,0.4,1\n0.5,4.3,0,1\n";
  EXPECT_EQ(fault(given), file +
                              ": tells the landmark from 0.01 to 0.5 s, not at 0 s, where the frame frame_0.stl is: "
                              "must tell all frames");
  std::ofstream(folder / "landmark.csv") << "time [ms],x,y,z\n0,4.3,0.4,1\n399.9999999999999,4.3,0,1\n";
  EXPECT_EQ(fault(given), "accepted") << "by round-off alone";
}

}  // namespace track_ring_test
}  // namespace tether
