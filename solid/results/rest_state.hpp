#pragma once

#include <optional>
#include <string>

#include "common/base/types.hpp"
#include "common/io/record.hpp"

namespace tether {

/// What the imaged wall asks of its surroundings so that it rests, beside its supports.
struct HeldBySurroundings {
  static constexpr const char* type_name = "held_by_surroundings";
  double share = 0, largest = 0;
  Vec3 place{0, 0, 0};
  std::string region;

  static void fields(auto& self, auto&& field) {
    field("share", self.share, "sum of the forces' magnitudes over that of the image's pressure");
    field("largest", self.largest, "of these forces over the area they act on, over the image's pressure");
    field("place", self.place, "where that is [length]");
    field("region", self.region, "of the outer wall, there");
  }
};

/// rest.json: how the wall rests in the image.
struct RestState {
  static constexpr const char* type_name = "rest_state";
  std::string wall;
  std::optional<double> residual;
  std::optional<HeldBySurroundings> held;

  static void fields(auto& self, auto&& field) {
    field("wall", self.wall, "image.wall: whether and how the imaged wall carries the image's pressure");
    field("residual", self.residual,
          "largest force left out of balance in the image, over the largest of the image's pressure; of nodes that are "
          "free to move; null: the pressure is zero");
    field("held", self.held, "by the surroundings, a dead load; null: the wall carries all by itself");
  }
};

}  // namespace tether
