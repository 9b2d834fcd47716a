#pragma once

#include <Eigen/Geometry>
#include <numbers>

#include "common/mesh/surface.hpp"
#include "observation_manager/measurements/signed_surface.hpp"

namespace tether::testing {

/// An open tube with this axis through the origin, from -length/2 to length/2, normals outward.
inline TriangleSurface tube(double radius, double length, int around, int along, const Vec3& axis = Vec3::UnitZ()) {
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), axis).toRotationMatrix();
  TriangleSurface surface{Points(3, around * (along + 1)), {}};
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / around;
      surface.points.col(j * around + i) = turn * Vec3(radius * std::cos(angle), radius * std::sin(angle),
                                                       length * (static_cast<double>(j) / along - 0.5));
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around, c = a + around, d = b + around;
      if (j % 2 == 0)
        surface.triangles.insert(surface.triangles.end(), {{a, b, c}, {b, d, c}});
      else
        surface.triangles.insert(surface.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return surface;
}

/// A sphere about the origin.
inline TriangleSurface sphere(double radius, int around, int along) {
  TriangleSurface surface = tube(1, 2, around, along);
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double polar = std::numbers::pi * (1 - static_cast<double>(j) / along);
      auto x = surface.points.col(j * around + i);
      x = radius * Vec3(x.x() * std::sin(polar), x.y() * std::sin(polar), std::cos(polar));
    }
  return surface;
}

inline double volume(const TriangleSurface& closed) {
  double sum = 0;
  for (const Triangle& t : closed.triangles) sum += area_vector(closed.points, t).dot(closed.points.col(t[0])) / 3;
  return sum;
}

}  // namespace tether::testing
