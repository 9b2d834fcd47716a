#pragma once

#include <fmt/format.h>

#include <string>

namespace tether {

/// A part of a region: between two places on the way along the vessel, from 0 at the wall's first ring to 1 at the
/// others, and what is nearer to one neighbouring region than to the others.
struct Band {
  double from = 0, to = 1;
  std::string toward = {};  ///< the neighbour; empty: all around
  bool is_all_along() const { return from <= 0 && to >= 1; }
  bool is_all() const { return is_all_along() && toward.empty(); }
  bool operator==(const Band&) const = default;
};

/// "outlet half", "toward vicinity_left".
inline std::string in_words(const Band& band) {
  std::string along;
  if (band.from == 0 && band.to == 0.5)
    along = "inlet half";
  else if (band.from == 0.5 && band.to == 1)
    along = "outlet half";
  else if (!band.is_all_along())
    along = fmt::format("{:g} to {:g} of the way", band.from, band.to);
  if (band.toward.empty()) return along;
  return (along.empty() ? "" : along + " ") + "toward " + band.toward;
}

}  // namespace tether
