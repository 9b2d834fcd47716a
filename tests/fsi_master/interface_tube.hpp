#pragma once

#include <cmath>
#include <numbers>

#include "fsi_master/transfer/interface_surface.hpp"

namespace tether {

inline constexpr double tube_radius = 2, tube_height = 6;

/// A tube along z; with a twist its rings are turned against each other, so that two of them share no nodes inside.
inline InterfaceSurface tube(int around, int along, double twist = 0) {
  InterfaceSurface tube{Points(3, around * (along + 1)), {}};
  for (int k = 0; k <= along; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around + twist * k / along;
      tube.points.col(k * around + i) << tube_radius * std::cos(angle), tube_radius * std::sin(angle),
          tube_height * k / along;
    }
  for (int k = 0; k < along; ++k)
    for (int i = 0; i < around; ++i) {
      const int a = k * around + i, b = k * around + (i + 1) % around;
      tube.triangles.push_back({a, b, b + around});
      tube.triangles.push_back({a, b + around, a + around});
    }
  return tube;
}

}  // namespace tether
