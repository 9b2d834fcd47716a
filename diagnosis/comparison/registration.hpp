#pragma once

#include <optional>
#include <vector>

#include "observation_manager/measurements/sample.hpp"

namespace tether {

/// A small rigid motion: x moves by displacement + rotation x (x - centre).
struct RigidMotion {
  Vec3 displacement{0, 0, 0};  ///< [length]
  Vec3 rotation{0, 0, 0};      ///< axis times angle [rad]
  Vec3 centre{0, 0, 0};        ///< [length]
};

/// The rigid motion that brings a surface closest to data, by distances along its normals. (D.16)
struct Registration {
  RigidMotion motion;       ///< of the data against the surface; zero along directions that the distances do not show
  double before = 0;        ///< root mean square distance [length]
  double after = 0;         ///< with that motion taken off the data
  double significance = 0;  ///< chi-square of what it explains, of 6 numbers
  /// Whether it explains most of the distance, and chance none of it: one in a million.
  bool stands_out() const;
};

/// deviation: of the noise of a distance; independent: how many independent distances the samples amount to. Nothing
/// without samples or noise.
std::optional<Registration> registration_of(const std::vector<Sample>& samples, double deviation, double independent);

}  // namespace tether
