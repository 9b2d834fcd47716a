#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "common/base/types.hpp"
#include "common/io/record.hpp"

namespace tether {

/// What lies no farther from a point than this, in space.
struct Ball {
  static constexpr const char* type_name = "ball";
  Vec3 centre{0, 0, 0};
  double radius = 0;
  bool operator==(const Ball&) const = default;

  static void fields(auto& self, auto&& field) {
    field("centre", self.centre, "on the wall [length]");
    field("radius", self.radius, "[length]");
  }
};

/// Where in its place an effect acts: between two places on the way along the vessel, from 0 at the wall's first ring
/// to 1 at the others; on what is nearer to one neighbouring region than to the others; and within a distance of a
/// point.
struct Extent {
  double from = 0, to = 1;
  std::string toward = {};         ///< the neighbour; empty: all around
  std::optional<Ball> about = {};  ///< none: anywhere
  bool is_all_along() const { return from <= 0 && to >= 1; }
  bool is_all() const { return is_all_along() && toward.empty() && !about; }
  bool operator==(const Extent&) const = default;
};

/// "outlet half", "middle half", "toward vicinity_left", "within 0.8 cm of (-1.6, 1.5, 6)".
inline std::string in_words(const Extent& extent, const std::string& unit_of_length) {
  std::string words;
  const auto add = [&words](const std::string& more) { words += (words.empty() ? "" : " ") + more; };
  if (extent.from == 0 && extent.to == 0.5)
    add("inlet half");
  else if (extent.from == 0.5 && extent.to == 1)
    add("outlet half");
  else if (extent.from == 0.25 && extent.to == 0.75)
    add("middle half");
  else if (!extent.is_all_along())
    add(fmt::format("{:g} to {:g} of the way", extent.from, extent.to));
  if (!extent.toward.empty()) add("toward " + extent.toward);
  if (const auto& ball = extent.about)
    add(fmt::format("within {:.3g} {} of ({:.3g}, {:.3g}, {:.3g})", ball->radius, unit_of_length, ball->centre[0],
                    ball->centre[1], ball->centre[2]));
  return words;
}

}  // namespace tether
