#include "vessel/ring/track_ring.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "common/base/csv.hpp"
#include "common/base/curve.hpp"
#include "common/base/error.hpp"
#include "common/base/shortened.hpp"
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
      throw input_error("{}: the time {} s of {} does not come after {} s", table.where(i), frames[i].time,
                        shortened(files[i]), frames[i - 1].time);
  if (frames.size() < 2)
    throw input_error("{}: lists {} frame: a motion needs at least two", given.file.string(), frames.size());
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

/// The ring's rim in a frame, of which there is one at least; `before`: null in the first.
const Rim& ring_of(const std::vector<Rim>& rims, const WhichRingCase& asked, const RingPose* before) {
  if (before != nullptr) return rims[nearest_rim(rims, before->centre)];
  const auto& near = asked.near;
  return near.empty() ? rims.front() : rims[rim_near(rims, Vec3(near[0], near[1], near[2]), "ring.near")];
}

/// The ring in a frame; `before`: null in the first.
RingPose pose_in(const FrameFile& frame, const RingTrackCase& asked, const RingPose* before) {
  const RawSurface surface = open_surface(frame.path, asked);
  const std::vector<Rim> rims = rims_of(surface);
  if (rims.empty()) throw input_error("the surface has no opening");
  if (const std::string wrong = wrong_width(rims.front().radius(), asked.frames.unit);
      !asked.frames.any_size && !wrong.empty())
    throw input_error("{}; frames.any_size: true takes it as it is", wrong);
  const Rim& rim = ring_of(rims, asked.ring, before);
  RingPose pose{frame.path.filename().string(), frame.time,       rim.radius(), rim.off_plane,
                barycentre(surface, rim),       rim.plane.normal, Vec3::Zero()};
  if (before != nullptr)
    if (const double way = (pose.centre - before->centre).norm(); way > 2 * before->radius)
      throw input_error(
          "the opening nearest to the ring is {:.3g} cm from where it was at {} s, farther than its width", way,
          before->time);
  return pose;
}

/// The landmark's way, told from the first to the last time of its table.
struct Path {
  fs::path file;
  double first, last;  ///< [s]
  std::array<Curve, 3> coordinates;

  Vec3 operator()(double time) const { return {coordinates[0](time), coordinates[1](time), coordinates[2](time)}; }

  void check_tells(const FrameFile& frame) const {
    const double round_off = 1e-9 * std::max({last - first, std::abs(first), std::abs(last)});
    if (frame.time >= first - round_off && frame.time <= last + round_off) return;
    throw input_error(
        "{}: tells the landmark from {} to {} s, not at {} s, where the frame {} is: must tell all frames",
        file.string(), first, last, frame.time, frame.path.filename().string());
  }
};

Path landmark_of(const LandmarkCase& given) {
  const CsvTable table(given.file);
  const UnitSystem units = UnitSystem::cgs();
  const std::vector<double> times = times_of(table, given.time);
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] <= times[i - 1])
      throw input_error("{}: the time {} s does not come after {} s", table.where(i), times[i], times[i - 1]);
  const auto curve = [&](const std::string& column) {
    return Curve(times, table.quantities(column, units, dimension::length, given.unit));
  };
  return {given.file, times.front(), times.back(), {curve(given.x), curve(given.y), curve(given.z)}};
}

/// What the tables say.
struct Tables {
  std::vector<FrameFile> frames;
  std::optional<Path> landmark;
};

Tables tables_of(const RingTrackCase& asked) {
  Tables tables{frames_of(asked.frames), std::nullopt};
  if (!asked.landmark) return tables;
  tables.landmark = landmark_of(*asked.landmark);
  for (const FrameFile& frame : tables.frames) tables.landmark->check_tells(frame);
  return tables;
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

void check_tables(const RingTrackCase& asked) {
  tables_of(asked);
}

TrackedRing track_ring(const RingTrackCase& asked) {
  TrackedRing ring;
  ring.name = asked.name;
  ring.turns_about_axis = asked.landmark.has_value();
  const auto [frames, landmark] = tables_of(asked);
  Mat3 first_axes = Mat3::Identity();
  for (const FrameFile& frame : frames) try {
      RingPose pose = pose_in(frame, asked, ring.poses.empty() ? nullptr : &ring.poses.back());
      if (landmark) {
        const Mat3 axes = axes_of(pose, (*landmark)(frame.time));
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
