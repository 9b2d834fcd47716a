#pragma once

#include <fmt/format.h>

#include <string>

namespace tether {

/// A part of the way along the vessel, from 0 at the wall's first ring to 1 at the others.
struct Band {
  double from = 0, to = 1;
  bool is_all() const { return from <= 0 && to >= 1; }
  bool operator==(const Band&) const = default;
};

/// "outlet half".
inline std::string in_words(const Band& band) {
  if (band == Band{0, 0.5}) return "inlet half";
  if (band == Band{0.5, 1}) return "outlet half";
  return fmt::format("{:g} to {:g} of the way", band.from, band.to);
}

}  // namespace tether
