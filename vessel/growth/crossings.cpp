#include "vessel/growth/crossings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "common/mesh/triangle_locator.hpp"

namespace tether {

namespace {

double volume_six(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

/// Whether a segment passes through a triangle; touching is none of it.
bool pierces(const Vec3& from, const Vec3& to, const Mat3& triangle) {
  const Vec3 a = triangle.col(0), b = triangle.col(1), c = triangle.col(2);
  if (volume_six(a, b, c, from) * volume_six(a, b, c, to) >= 0) return false;
  const double ab = volume_six(from, to, a, b), bc = volume_six(from, to, b, c), ca = volume_six(from, to, c, a);
  return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
}

bool any_edge_pierces(const Mat3& one, const Mat3& other) {
  for (Eigen::Index i = 0; i < 3; ++i)
    if (pierces(one.col(i), one.col((i + 1) % 3), other)) return true;
  return false;
}

bool share_node(const Triangle& one, const Triangle& other) {
  return std::any_of(one.begin(), one.end(),
                     [&](int node) { return std::find(other.begin(), other.end(), node) != other.end(); });
}

}  // namespace

std::vector<int> crossing_triangles(const Points& points, const std::vector<Triangle>& triangles) {
  const TriangleLocator locator(points, triangles);
  std::set<int> found;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Mat3 one = points(Eigen::all, triangles[i]);
    locator.overlapping(one.rowwise().minCoeff(), one.rowwise().maxCoeff(), [&](int j) {
      const Triangle& t = triangles[static_cast<std::size_t>(j)];
      if (j <= static_cast<int>(i) || share_node(t, triangles[i])) return;
      const Mat3 other = points(Eigen::all, t);
      if (any_edge_pierces(one, other) || any_edge_pierces(other, one)) found.insert({static_cast<int>(i), j});
    });
  }
  return {found.begin(), found.end()};
}

}  // namespace tether
