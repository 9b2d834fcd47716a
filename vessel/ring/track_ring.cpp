#include "vessel/ring/track_ring.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>

#include "common/base/csv.hpp"
#include "common/base/curve.hpp"
#include "common/base/error.hpp"
#include "vessel/study/read_surface.hpp"
#include "vessel/surface/rims.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

struct FrameFile {
  double time;
  fs::path path;
};

/// Frames and landmarks come from other programs: the unit of their times is stated, never guessed.
std::vector<double> times_of(const CsvTable& table, const std::string& column) {
  if (table.unit(column).empty())
    throw input_error("{}: the unit of {} must stand in its heading, as in {} [ms]", table.where(0), column, column);
  return table.quantities(column, UnitSystem::cgs(), dimension::time);
}

std::vector<FrameFile> frames_of(const FramesCase& given) {
  const CsvTable table(given.file);
  const std::vector<double> times = times_of(table, given.time);
  const std::vector<std::string> files = table.texts(given.column);
  std::vector<FrameFile> frames;
  for (std::size_t i = 0; i < times.size(); ++i) frames.push_back({times[i], given.file.parent_path() / files[i]});
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (frames[i].time <= frames[i - 1].time)
      throw input_error("{}: the time {} s of {} does not come after {} s", table.where(i), frames[i].time, files[i],
                        frames[i - 1].time);
  return frames;
}

/// The surface with its openings open.
RawSurface open_surface(const fs::path& file, const RingTrackCase& asked) {
  SurfaceCase given;
  given.file = file;
  given.unit = asked.frames.unit;
  given.label_array = asked.frames.label_array;
  constexpr double same_point = 1e-5;  // [cm], as of a study
  Repaired state{read_surface(given), {}};
  merge_points(state, same_point);
  if (state.surface.triangles.empty()) throw input_error("{}: all its triangles are without area", file.string());
  drop_fins(state);
  keep_largest_piece(state);
  split_points(state);
  orient(state);
  if (asked.ring.label != 0)
    open_labels(state.surface, {asked.ring.label});
  else if (rims_of(state.surface).empty())
    open_flat_ends(state);
  return std::move(state.surface);
}

/// The mean place of the rim's line: where its points lie does not count.
Vec3 barycentre(const RawSurface& surface, const Rim& rim) {
  Vec3 sum = Vec3::Zero();
  double length = 0;
  for (std::size_t i = 0; i < rim.nodes.size(); ++i) {
    const Vec3 a = surface.points.col(rim.nodes[i]), b = surface.points.col(rim.nodes[(i + 1) % rim.nodes.size()]);
    sum += (b - a).norm() * (a + b) / 2;
    length += (b - a).norm();
  }
  return sum / length;
}

/// The rim nearest to a place.
const Rim& nearest(const std::vector<Rim>& rims, const Vec3& place) {
  return *std::min_element(rims.begin(), rims.end(), [&](const Rim& a, const Rim& b) {
    return (a.plane.origin - place).norm() < (b.plane.origin - place).norm();
  });
}

/// The ring in a frame; `before`: null in the first.
RingPose pose_in(const FrameFile& frame, const RingTrackCase& asked, const RingPose* before) {
  const RawSurface surface = open_surface(frame.path, asked);
  const std::vector<Rim> rims = rims_of(surface);
  if (rims.empty()) throw input_error("the surface has no opening");
  const auto& near = asked.ring.near;
  const Rim& rim = before != nullptr ? nearest(rims, before->centre)
                   : near.empty()    ? rims.front()
                                     : nearest(rims, Vec3(near[0], near[1], near[2]));
  RingPose pose{frame.path.filename().string(), frame.time,       rim.radius(), rim.off_plane,
                barycentre(surface, rim),       rim.plane.normal, Vec3::Zero()};
  if (before != nullptr)
    if (const double way = (pose.centre - before->centre).norm(); way > 2 * before->radius)
      throw input_error(
          "the opening nearest to the ring is {:.3g} cm from where it was at {} s, farther than its width", way,
          before->time);
  return pose;
}

using Path = std::function<Vec3(double time)>;

Path landmark_of(const LandmarkCase& given) {
  const CsvTable table(given.file);
  const UnitSystem units = UnitSystem::cgs();
  const std::vector<double> times = times_of(table, given.time);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] <= times[i - 1])
      throw input_error("{}: the time {} s does not come after {} s", table.where(i), times[i], times[i - 1]);
  std::vector<Curve> curves;
  for (const std::string& column : {given.x, given.y, given.z})
    curves.emplace_back(times, table.quantities(column, units, dimension::length, given.unit));
  return [curves](double time) -> Vec3 { return {curves[0](time), curves[1](time), curves[2](time)}; };
}

constexpr double least_angle = 5;  // [degrees] of the landmark from the axis: nearer, its error would be the turn's

/// Axes of the ring: its normal, and the direction across it in which the landmark lies.
Mat3 axes_of(const RingPose& pose, const Vec3& landmark) {
  const Vec3 arm = landmark - pose.centre, across = arm - arm.dot(pose.normal) * pose.normal;
  if (across.norm() < std::sin(least_angle * std::numbers::pi / 180) * arm.norm())
    throw input_error("the landmark lies within {} degrees of the ring's axis: it cannot tell a turn about it",
                      least_angle);
  Mat3 axes;
  axes << pose.normal, across.normalized(), pose.normal.cross(across).normalized();
  return axes;
}

Vec3 turn_of(const Eigen::AngleAxisd& rotation) {
  return rotation.angle() * rotation.axis();
}

}  // namespace

TrackedRing track_ring(const RingTrackCase& asked) {
  TrackedRing ring;
  ring.name = asked.name;
  ring.turns_about_axis = asked.landmark.has_value();
  Path landmark;
  if (asked.landmark) landmark = landmark_of(*asked.landmark);
  Mat3 first_axes = Mat3::Identity();
  for (const FrameFile& frame : frames_of(asked.frames)) try {
      RingPose pose = pose_in(frame, asked, ring.poses.empty() ? nullptr : &ring.poses.back());
      if (landmark) {
        const Mat3 axes = axes_of(pose, landmark(frame.time));
        if (ring.poses.empty()) first_axes = axes;
        pose.turn = turn_of(Eigen::AngleAxisd(Mat3(axes * first_axes.transpose())));
      } else if (!ring.poses.empty()) {
        pose.turn =
            turn_of(Eigen::AngleAxisd(Eigen::Quaterniond::FromTwoVectors(ring.poses.front().normal, pose.normal)));
      }
      ring.poses.push_back(std::move(pose));
    } catch (const InputError& error) {
      throw input_error("frame at {} s, {}: {}", frame.time, frame.path.string(), error.what());
    }
  const RingPose& first = ring.poses.front();
  for (const RingPose& pose : ring.poses) {
    ring.largest_way = std::max(ring.largest_way, (pose.centre - first.centre).norm());
    const double cosine = std::clamp(pose.normal.dot(first.normal), -1.0, 1.0);
    ring.largest_tilt = std::max(ring.largest_tilt, std::acos(cosine) * 180 / std::numbers::pi);
  }
  return ring;
}

}  // namespace tether
