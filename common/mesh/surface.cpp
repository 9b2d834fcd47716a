#include "common/mesh/surface.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace tether {

Vec3 area_vector(const Points& points, const Triangle& t) {
  const Vec3 a = points.col(t[1]) - points.col(t[0]), b = points.col(t[2]) - points.col(t[0]);
  return 0.5 * a.cross(b);
}

Vec3 total_area_vector(const Points& points, const std::vector<Triangle>& triangles) {
  Vec3 sum = Vec3::Zero();
  for (const Triangle& t : triangles) sum += area_vector(points, t);
  return sum;
}

double total_area(const Points& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += area_vector(points, t).norm();
  return sum;
}

VectorXd nodal_areas(const Points& points, const std::vector<Triangle>& triangles) {
  VectorXd areas = VectorXd::Zero(points.cols());
  for (const Triangle& t : triangles) {
    const double third = area_vector(points, t).norm() / 3;
    for (const int node : t) areas[node] += third;
  }
  return areas;
}

Vec3 centroid(const Points& points, const std::vector<Triangle>& triangles) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const Triangle& t : triangles) {
    const double weight = area_vector(points, t).norm();
    sum += weight / 3.0 * (points.col(t[0]) + points.col(t[1]) + points.col(t[2]));
    area += weight;
  }
  return sum / area;
}

Points nodal_normals(const Points& points, const std::vector<Triangle>& triangles) {
  Points normals = Points::Zero(3, points.cols());
  for (const Triangle& t : triangles) {
    const Vec3 normal = area_vector(points, t).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = points.col(t[(i + 1) % 3]) - points.col(t[i]), b = points.col(t[(i + 2) % 3]) - points.col(t[i]);
      normals.col(t[i]) += std::atan2(a.cross(b).norm(), a.dot(b)) * normal;
    }
  }
  for (Eigen::Index node = 0; node < normals.cols(); ++node) normals.col(node).normalize();
  return normals;
}

Plane plane_of_loop(const Points& loop) {
  Plane plane{loop.rowwise().mean(), Vec3::Zero()};
  for (Eigen::Index i = 0; i < loop.cols(); ++i) {
    const Vec3 a = loop.col(i) - plane.origin, b = loop.col((i + 1) % loop.cols()) - plane.origin;
    plane.normal += a.cross(b);
  }
  plane.normal.normalize();
  return plane;
}

Vec3 closest_in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  // Ericson, Real-Time Collision Detection (2005), 5.1.5: by the Voronoi region of vertex, edge or face.
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - w, w};
  }
  return Vec3(va, vb, vc) / (va + vb + vc);
}

}  // namespace tether
