#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A ring in one frame.
struct RingPose {
  static constexpr const char* type_name = "ring_pose";
  std::string file;
  double time = 0, radius = 0, off_plane = 0;
  Vec3 centre = Vec3::Zero(), normal = Vec3::Zero(), turn = Vec3::Zero();

  static void fields(auto& self, auto&& field) {
    field("file", self.file, "the frame's surface");
    field("time", self.time, "[s]");
    field("centre", self.centre, "barycentre of the rim [cm]");
    field("normal", self.normal, "of the rim's plane, out of the vessel");
    field("turn", self.turn, "since the first frame, axis times angle [rad]");
    field("radius", self.radius, "of the circle with the opening's area [cm]");
    field("off_plane", self.off_plane, "greatest distance of the rim from its plane [cm]");
  }
};

/// ring.json: an opening's ring through the frames.
struct TrackedRing {
  static constexpr const char* type_name = "tracked_ring";
  std::string name;
  bool turns_about_axis = false;
  double largest_way = 0, largest_tilt = 0;
  std::vector<RingPose> poses;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "");
    field("turns_about_axis", self.turns_about_axis,
          "whether a landmark told the turn about the ring's axis; without one there is none");
    field("largest_way", self.largest_way, "of the centre from where it is in the first frame [cm]");
    field("largest_tilt", self.largest_tilt, "of the normal from that of the first frame [degrees]");
    field("poses", self.poses, "one a frame");
  }
};

}  // namespace tether
