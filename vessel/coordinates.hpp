#pragma once

#include <fmt/format.h>

#include <string>

#include "common/base/types.hpp"

namespace tether {

/// "(0.012, -0.4, 1.25)": a place, as messages name it.
inline std::string coordinates(const Vec3& x, int digits = 4) {
  return fmt::format("({:.{}g}, {:.{}g}, {:.{}g})", x[0], digits, x[1], digits, x[2], digits);
}

}  // namespace tether
