#pragma once

#include <optional>
#include <vector>

#include "vessel/image/image_volume.hpp"

namespace tether {

/// A sphere inside a lumen.
struct InnerSphere {
  Vec3 place = Vec3::Zero();
  double radius = 0;  ///< [cm], to some 10 %
};

/// How wide a lumen is, and where it is reached through a neck at most half as wide as the room behind.
struct Widths {
  InnerSphere widest;
  struct Neck {
    InnerSphere door, room;
  };
  std::optional<Neck> neck;  ///< the one with the widest room for its door
};

/// Of the part where a field is positive that hangs together with the seeds; without seeds, with its widest place.
Widths widths_of(const ImageVolume& field, const std::vector<std::size_t>& seeds);

}  // namespace tether
