#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/types.hpp"
#include "common/io/record.hpp"

namespace tether {

/// A region that a patch of the wall lies in.
struct PatchShare {
  static constexpr const char* type_name = "patch_share";
  std::string region;
  double share = 0;

  static void fields(auto& self, auto&& field) {
    field("region", self.region, "of the wall");
    field("share", self.share, "of the patch");
  }
};

/// Where on the wall a misfit is largest, whatever the regions that the case has. (D.24)
struct LocatedMisfit {
  static constexpr const char* type_name = "located_misfit";
  Vec3 centre{0, 0, 0};
  double radius = 0, resolution = 0, amount = 0, time = 0, z = 0, p = 1;
  std::string unit;
  std::vector<PatchShare> regions;

  static void fields(auto& self, auto&& field) {
    field("centre", self.centre, "of the patch, on the lumen");
    field("radius", self.radius, "at which it has fallen to 0.6 of what it is at the centre");
    field("resolution", self.resolution,
          "how far from there its centre may be too (95 %), at least the way to the next place that was tried");
    field("amount", self.amount, "by how much the data lie outside the model at the centre, at most; negative: inside");
    field("time", self.time, "when [s]");
    field("unit", self.unit, "of centre, radius, resolution and amount");
    field("z", self.z, "significance, of the one patch");
    field("p", self.p, "probability that chance makes one of all patches as significant");
    field("regions", self.regions, "that the patch lies in, the largest share first");
  }
};

struct LocatedMisfits {
  static constexpr const char* type_name = "located_misfits";
  std::optional<LocatedMisfit> before, after;

  static void fields(auto& self, auto&& field) {
    field("before", self.before, "of the model as it is");
    field("after", self.after, "with what was accepted");
  }
};

/// By so many deviations neither noise nor errors allowed lay a place off, whatever else is unsure.
constexpr double no_noise_does = 6;
inline bool is_no_noise(const std::optional<LocatedMisfit>& misfit) {
  return misfit && misfit->z > no_noise_does;
}

}  // namespace tether
