#pragma once

#include <cmath>
#include <numbers>

#include "common/protocol/messages.hpp"

namespace tether::fakes {

/// The lumen's surface of a straight tube (radius 1, length 2), normals outward: what both fakes offer as Sigma.
inline protocol::Interface tube(int around = 6, int along = 3) {
  protocol::Interface surface;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      surface.points.insert(surface.points.end(), {std::cos(angle), std::sin(angle), 2.0 * j / (along - 1)});
    }
  for (int j = 0; j + 1 < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around, c = b + around, d = a + around;
      surface.triangles.insert(surface.triangles.end(), {a, b, c, a, c, d});
    }
  return surface;
}

}  // namespace tether::fakes
