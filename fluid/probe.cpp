#include "fluid/probe.hpp"

#include <limits>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "fluid/geometry.hpp"

namespace tether::fluid {
namespace {

/// A point on the surface may have a barycentric coordinate below zero by rounding.
constexpr double rounding = 1e-8;

Eigen::Vector4d barycentric(const Vec3& position, const Nodal& corners) {
  const Vec3 from_centre = position - corners.rowwise().mean();
  return (tet_geometry(corners).grad_N.transpose() * from_centre).array() + 0.25;
}

double distance(const Vec3& position, const std::vector<Triangle>& triangles, const Points& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) {
    const Mat3 corners = points(Eigen::all, {a, b, c});
    const Vec3 closest = corners * closest_in_triangle(position, corners.col(0), corners.col(1), corners.col(2));
    least = std::min(least, (closest - position).norm());
  }
  return least;
}

double distance_to_surface(const Vec3& position, const FluidMesh& mesh) {
  double least = distance(position, mesh.interface, mesh.points);
  for (const auto* patches : {&mesh.inlets, &mesh.outlets})
    for (const Patch& patch : *patches) least = std::min(least, distance(position, patch.triangles, mesh.points));
  return least;
}

}  // namespace

double Probe::value(const VectorXd& field) const {
  return weights.dot(field(tetrahedron));
}

Probe place_probe(const std::string& name, const Vec3& position, const FluidMesh& mesh) {
  for (const Tetrahedron& tetrahedron : mesh.tetrahedra) {
    const Eigen::Vector4d weights = barycentric(position, gather(mesh.points, tetrahedron));
    if (weights.minCoeff() >= -rounding) return {name, tetrahedron, weights};
  }
  throw input_error("({:.6g}, {:.6g}, {:.6g}) lies outside the blood, {:.4g} from its surface", position.x(),
                    position.y(), position.z(), distance_to_surface(position, mesh));
}

}  // namespace tether::fluid
