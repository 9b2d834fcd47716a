#include "vessel/surface/measure.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/mesh/surface.hpp"
#include "vessel/surface/cgal_mesh.ipp"
#include "vessel/surface/edges.hpp"
#include "vessel/surface/tidy.hpp"

namespace tether {
namespace {

double least_angle(const Points& points, const Triangle& t) {
  double least = 180;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = points.col(t[(i + 1) % 3]) - points.col(t[i]), b = points.col(t[(i + 2) % 3]) - points.col(t[i]);
    least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
  }
  return least;
}

RawSurface raw(const LabelledSurface& surface) {
  return {surface.points, surface.triangles, surface.label};
}

void add_distances(const RawSurface& from, const RawSurface& to, std::vector<double>& distances) {
  const CgalMesh mesh = cgal_mesh(to);
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
  const CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(mesh).first, faces(mesh).second, mesh);
  const auto add = [&](const Vec3& x) {
    distances.push_back(std::sqrt(tree.squared_distance(Kernel::Point_3(x[0], x[1], x[2]))));
  };
  for (const auto& x : from.points.colwise()) add(x);
  for (std::size_t t = 0; t < from.triangles.size(); ++t) add(middle(from, t));
}

}  // namespace

SurfaceMeasures measures_of(const LabelledSurface& surface) {
  SurfaceMeasures m;
  m.points = static_cast<int>(surface.points.cols());
  m.triangles = static_cast<int>(surface.triangles.size());
  std::vector<double> angles;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    angles.push_back(least_angle(surface.points, surface.triangles[t]));
    if (surface.label[t] == 0) m.wall_area += area_vector(surface.points, surface.triangles[t]).norm();
  }
  std::sort(angles.begin(), angles.end());
  m.least_angle = angles.front();
  m.least_angle_of_100 = angles[angles.size() / 100];
  m.volume = enclosed_volume(raw(surface));
  const EdgeUses edges = edges_of(surface.triangles);
  for (const auto& [edge, uses] : edges)
    m.mean_edge +=
        (surface.points.col(edge.first) - surface.points.col(edge.second)).norm() / static_cast<double>(edges.size());
  return m;
}

SurfaceDistance distance_between(const LabelledSurface& a, const LabelledSurface& b) {
  std::vector<double> distances;
  add_distances(raw(a), raw(b), distances);
  add_distances(raw(b), raw(a), distances);
  std::sort(distances.begin(), distances.end());
  SurfaceDistance d;
  for (const double one : distances) d.mean += one / static_cast<double>(distances.size());
  d.p95 = distances[distances.size() * 95 / 100];
  d.greatest = distances.back();
  return d;
}

}  // namespace tether
