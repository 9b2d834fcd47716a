#pragma once

#include <string>

#include "common/catalogue/extent.hpp"

namespace tether {

/// Where and how large a patch of the wall is in which an effect explains what no region holds, and how exactly that is
/// known. (D.25)
struct PatchPlace {
  static constexpr const char* type_name = "patch_place";
  Ball patch;
  double known_to = 0, least_radius = 0, largest_radius = 0;
  int tried = 0;
  std::string unit;

  static void fields(auto& self, auto&& field) {
    field("patch", self.patch, "the one that explains most");
    field("known_to", self.known_to,
          "how far from there its centre may be too (95 %), at least the way to the next place that was tried");
    field("least_radius", self.least_radius, "of those that explain as much (95 %)");
    field("largest_radius", self.largest_radius, "of those that explain as much (95 %)");
    field("tried", self.tried, "number of patches");
    field("unit", self.unit, "of lengths");
  }
};

}  // namespace tether
