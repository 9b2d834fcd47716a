#include "vessel/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/mesh/mesh.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"

namespace tether {

namespace {

std::array<Vec3, 4> face_vectors(const Points& points, const Tetrahedron& tetrahedron) {
  std::array<Vec3, 4> faces;
  for (std::size_t f = 0; f < 4; ++f) {
    Triangle face;
    for (std::size_t i = 0; i < 3; ++i) face[i] = tetrahedron[static_cast<std::size_t>(tetrahedron_faces[f][i])];
    faces[f] = area_vector(points, face);
  }
  return faces;
}

}  // namespace

double radius_ratio(const Points& points, const Tetrahedron& t) {
  const double volume = signed_volume(points, t);
  if (!(volume > 0)) return 0;
  double area = 0;
  for (const Vec3& face : face_vectors(points, t)) area += face.norm();
  const Vec3 a = points.col(t[1]) - points.col(t[0]), b = points.col(t[2]) - points.col(t[0]),
             c = points.col(t[3]) - points.col(t[0]);
  const Vec3 numerator = a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
  const double circumscribed = numerator.norm() / (12 * volume), inscribed = 3 * volume / area;
  return 3 * inscribed / circumscribed;
}

double min_dihedral_angle(const Points& points, const Tetrahedron& t) {
  const std::array<Vec3, 4> faces = face_vectors(points, t);
  double smallest = std::numbers::pi;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      smallest =
          std::min(smallest, std::numbers::pi - std::atan2(faces[i].cross(faces[j]).norm(), faces[i].dot(faces[j])));
  return smallest * 180 / std::numbers::pi;
}

Quality quality(const Points& points, const std::vector<Tetrahedron>& tetrahedra) {
  Quality result;
  double sum = 0;
  for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
    const double ratio = radius_ratio(points, tetrahedra[e]);
    sum += ratio;
    result.min_dihedral = std::min(result.min_dihedral, min_dihedral_angle(points, tetrahedra[e]));
    if (ratio < result.min_radius_ratio || e == 0) {
      result.min_radius_ratio = ratio;
      result.worst = static_cast<int>(e);
    }
  }
  if (!tetrahedra.empty()) result.mean_radius_ratio = sum / static_cast<double>(tetrahedra.size());
  return result;
}

}  // namespace tether
