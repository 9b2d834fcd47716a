/// Frames of an arch that a measured heart pulls: the ring tracked in them moves a case's ring as the heart did.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/io/vtp_writer.hpp"
#include "solid/motion_case.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/mesh_file.hpp"
#include "vessel/ring/ring_text.hpp"
#include "vessel/ring/track_ring.hpp"
#include "vessel/surface/remesh.hpp"
#include "vessel/surface/rims.hpp"

namespace tether {
namespace measured_heart_test {

const std::string data = TETHER_SOURCE "/data/";
const Vec3 root(14.8364, 16.4129, 27.3272);  // the inlet's middle, of the arch's regions.csv
constexpr double period = 0.8955;
constexpr int frames = 12;

/// What configs/thoracic_aorta asks for, about the inlet's middle.
MotionCase measured() {
  MotionCase given;
  given.file = data + "heart_motion_patient1/ring_points.csv";
  given.table = "points", given.clock = given.time = "phase", given.unit = "mm";
  given.x = "x_mm", given.y = "y_mm", given.z = "z_mm";
  given.period = period, given.harmonics = 3;
  given.placement = {{0.8616, 0.4140, -0.2937}, {-0.2574, 0.8551, 0.4501}};
  return given;
}

/// A ring whose middle is the root's.
Points corners() {
  Points ring(3, 3);
  ring << Vec3(root + Vec3(1, 0, 0)), Vec3(root + Vec3(-0.5, 1, 0)), Vec3(root + Vec3(-0.5, -1, 0));
  return ring;
}
Patch ring_patch() {
  Patch patch;
  patch.triangles = {{0, 1, 2}};
  return patch;
}

LabelledSurface arch() {
  const MeshFile file = read_mesh_file(data + "aortic_arch_adult/arch_surface.vtp");
  LabelledSurface surface;
  surface.points = 0.1 * file.points, surface.triangles = file.triangles;
  for (const auto label : file.triangle_labels.at("ModelFaceID")) surface.label.push_back(static_cast<int>(label));
  surface.openings = {"ascending", "brachiocephalic", "left_carotid", "left_subclavian", "descending"};
  return surface;
}

/// The first centimetres of it, between two flat caps; that of the root is 1.
LabelledSurface cut_arch() {
  const LabelledSurface whole = arch();
  RawSurface open{whole.points, whole.triangles, whole.label};
  open_labels(open, {1});
  cut_off(open, {Vec3(14.6, 15.2, 31), Vec3::UnitZ()});
  for (const Rim& rim : rims_of(open)) fill(open, rim, (rim.plane.origin - root).norm() < 1 ? 1 : 2);
  return {open.points, open.triangles, open.face_id, {"root", "cut"}};
}

/// All within 2 cm of the root goes with it, nothing beyond 8 cm.
Points pulled(Points points, const AffineDisplacement& heart) {
  for (auto x : points.colwise()) {
    const double far = std::clamp(((x - root).norm() - 2) / 6, 0.0, 1.0);
    x += (1 - far * far * (3 - 2 * far)) * heart.at(x);
  }
  return points;
}

class MeasuredHeart : public ::testing::Test {
 protected:
  /// The frames' surface: its points moved to each frame; with `anew`, of other triangles in each.
  void make(const LabelledSurface& surface, bool anew) {
    table_ << "file,time [s]\n", landmarks_ << "time [s],x [cm],y [cm],z [cm]\n";
    const RigidMotion heart = measured().load(UnitSystem::cgs(), ring_patch(), corners());
    for (int i = 0; i < frames; ++i) {
      const double time = period * i / frames;
      const std::string file = fmt::format("frame_{}.vtp", i);
      LabelledSurface now = surface;
      if (anew) now = remeshed(surface, {.most = 0.2 + 0.01 * i}, {});
      write_vtp(folder_ / file, pulled(now.points, heart(time)), now.triangles, now.label);
      table_ << fmt::format("{},{:.9g}\n", file, time);
      const Vec3 ostium = root + Vec3(1.5, -0.5, 0.5), there = ostium + heart(time).at(ostium);
      landmarks_ << fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", time, there[0], there[1], there[2]);
    }
    table_.close(), landmarks_.close();
  }
  TrackedRing tracked(bool landmark) const {
    RingTrackCase asked;
    asked.name = "root";
    asked.frames.file = folder_ / "frames.csv";
    asked.frames.unit = "cm";
    asked.ring.label = 1;
    if (landmark) asked.landmark.emplace().file = folder_ / "landmark.csv";
    return track_ring(asked);
  }
  /// How far, at most over frames and corners of the root's ring, a case that reads the poses is from the heart.
  double off(const TrackedRing& ring, int harmonics) const {
    write_poses(folder_ / "poses.csv", ring);
    MotionCase given;
    given.file = folder_ / "poses.csv";
    given.table = "poses", given.period = period, given.harmonics = harmonics;
    const Points x = corners();
    const RigidMotion read = given.load(UnitSystem::cgs(), ring_patch(), x);
    const RigidMotion heart = measured().load(UnitSystem::cgs(), ring_patch(), x);
    double worst = 0;
    for (int i = 0; i < frames; ++i)
      for (const auto& corner : x.colwise()) {
        const double time = period * i / frames;
        worst = std::max(worst, (read(time).at(corner) - heart(time).at(corner)).norm());
      }
    std::cout << fmt::format("{} harmonics: off by {:.2g} cm at most\n", harmonics, worst);
    return worst;
  }

 private:
  TemporaryFolder folder_;
  std::ofstream table_{folder_ / "frames.csv"}, landmarks_{folder_ / "landmark.csv"};
};

TEST_F(MeasuredHeart, IsReadBackFromTheFrames) {
  make(arch(), false);
  const TrackedRing ring = tracked(true);
  EXPECT_GT(ring.largest_way, 1.2) << "cm";
  EXPECT_LT(off(ring, 0), 1e-5) << "cm: seven digits of the frames";
  EXPECT_LT(off(ring, 3), 1e-3) << "cm: a product of series is nearly one";
}

TEST_F(MeasuredHeart, WithoutALandmarkTheTurnAboutTheAxisIsWhatIsLost) {
  make(arch(), false);
  const TrackedRing ring = tracked(false), whole = tracked(true);
  for (std::size_t i = 0; i < ring.poses.size(); ++i) {
    EXPECT_LT((ring.poses[i].centre - whole.poses[i].centre).norm(), 1e-12);
    const auto turn = [](const Vec3& axis) {
      return axis.norm() > 0 ? Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix()
                             : Mat3(Mat3::Identity());
    };
    const Vec3 normal = ring.poses[0].normal;
    EXPECT_LT((turn(ring.poses[i].turn) * normal - turn(whole.poses[i].turn) * normal).norm(), 1e-9);
    EXPECT_LT(std::abs(ring.poses[i].turn.dot(normal)), 1e-9) << "no turn about the axis";
  }
}

TEST_F(MeasuredHeart, DoesNotDependOnTheFramesTriangles) {
  make(cut_arch(), true);
  EXPECT_LT(off(tracked(true), 0), 0.01) << "cm: chords of other corners of the rim";
}

}  // namespace measured_heart_test
}  // namespace tether
