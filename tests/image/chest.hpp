#pragma once

#include <algorithm>

#include "common/base/types.hpp"

namespace tether::testing {

/// What lies about the arch of data/aortic_arch_adult in a chest: grey values by place and distance from the lumen.
struct Chest {
  double tissue = 50, lumen = 350;
  double vein = 0, artery = 0;  ///< parts of the lumen's contrast, of the superior vena cava, of the pulmonary artery
  bool lungs = false, spine = false, ventricle = false;
  std::vector<Vec3> calcifications = {};

  double operator()(const Vec3& x, double distance) const {
    double value = tissue;
    const auto contrast = [&](double share) { return tissue + share * (lumen - tissue); };
    if (lungs && distance > 0.2 && (x[0] > 18.5 || x[0] < 12.5) && x[2] < 34) value = -800;
    if (vein > 0 && off({12.3, 16, 27}, {12.3, 16, 34}, x) < 0.95) value = contrast(vein);
    if (artery > 0 && off({17.6, 13.5, 28}, {17.2, 16.5, 32}, x) < 1.4) value = contrast(artery);
    if (ventricle && (x - Vec3(15.5, 18, 25)).norm() < 2.3) value = lumen;
    if (const double bone = off({17.5, 26.5, 10}, {17.5, 26.5, 40}, x); spine && bone < 1.9)
      value = bone > 1.7 ? 800 : 300;
    for (const Vec3& spot : calcifications)
      if ((x - spot).norm() < 0.25) value = 900;
    return value;
  }

 private:
  /// Distance from a line between two points.
  static double off(const Vec3& a, const Vec3& b, const Vec3& x) {
    const double along = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - along * (b - a)).norm();
  }
};

}  // namespace tether::testing
