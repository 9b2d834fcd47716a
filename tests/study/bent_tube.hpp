#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "vessel/surface/raw_surface.hpp"

namespace tether::testing {

/// An open bent tube, a part of a torus in the plane z = 0, outward: radius 1 cm, bent with 4 cm over 120 degrees.
inline constexpr double tube_radius = 1, bend_radius = 4, bend_angle = 2 * std::numbers::pi / 3;

inline Vec3 tube_middle(double s) {
  return {bend_radius * std::cos(s * bend_angle), bend_radius * std::sin(s * bend_angle), 0};
}

inline RawSurface bent_tube(int around = 32, int along = 44) {
  RawSurface tube{Points(3, around * (along + 1)), {}, {}};
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const Vec3 middle = tube_middle(static_cast<double>(j) / along);
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
      tube.points.col(j * around + i) =
          middle + tube_radius * (std::cos(angle) * middle.normalized() + std::sin(angle) * Vec3::UnitZ());
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
      if (j % 2 == 0)
        tube.triangles.insert(tube.triangles.end(), {{a, c, b}, {b, c, d}});
      else
        tube.triangles.insert(tube.triangles.end(), {{a, d, b}, {a, c, d}});
    }
  tube.face_id.assign(tube.triangles.size(), 0);
  return tube;
}

/// Of the tube with exactly round sections (Pappus).
inline double tube_volume() {
  return std::numbers::pi * tube_radius * tube_radius * bend_radius * bend_angle;
}

inline void write_stl(const std::filesystem::path& file, const RawSurface& surface) {
  std::ofstream out(file);
  out << "solid s\n";
  for (const Triangle& t : surface.triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int n : t)
      out << fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", surface.points(0, n), surface.points(1, n),
                         surface.points(2, n));
    out << "endloop\nendfacet\n";
  }
  out << "endsolid s\n";
}

}  // namespace tether::testing
