#include "fluid/surface.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"

namespace tether::fluid {
namespace {

/// The tetrahedron behind each boundary triangle.
std::vector<int> elements_behind(const std::vector<Triangle>& triangles, const std::vector<Tetrahedron>& tetrahedra) {
  std::map<Triangle, std::size_t> place;
  for (std::size_t t = 0; t < triangles.size(); ++t) place[sorted(triangles[t])] = t;
  std::vector<int> result(triangles.size(), -1);
  for (std::size_t e = 0; e < tetrahedra.size(); ++e)
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      const auto& tet = tetrahedra[e];
      const auto found =
          place.find(sorted({tet[(opposite + 1) % 4], tet[(opposite + 2) % 4], tet[(opposite + 3) % 4]}));
      if (found != place.end()) result[found->second] = static_cast<int>(e);
    }
  if (std::find(result.begin(), result.end(), -1) != result.end())
    throw InputError("a boundary triangle of the fluid mesh is not a face of any tetrahedron");
  return result;
}

Vec3 area_vector_change(const Points& x, const Points& motion, const Triangle& t) {
  const Vec3 a = x.col(t[1]) - x.col(t[0]), b = x.col(t[2]) - x.col(t[0]);
  const Vec3 da = motion.col(t[1]) - motion.col(t[0]), db = motion.col(t[2]) - motion.col(t[0]);
  return 0.5 * (da.cross(b) + a.cross(db));
}

}  // namespace

Surface::Surface(const std::vector<Triangle>& all, const FluidMesh& mesh)
    : nodes(nodes_of(all)), triangles(all), tetrahedra(elements_behind(all, mesh.tetrahedra)) {
  for (auto& triangle : triangles)
    for (int& node : triangle)
      node = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  place(mesh.points);
}

void Surface::place(const Points& points) {
  place_locally(local(points));
}

void Surface::place_locally(const Points& x) {
  area_vectors.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    area_vectors.col(static_cast<Eigen::Index>(t)) = area_vector(x, triangles[t]);
}

Points Surface::local(const Points& field) const {
  return field(Eigen::all, nodes);
}
VectorXd Surface::local(const VectorXd& field) const {
  return field(nodes);
}

VectorXd Surface::flux(const Points& velocity) const {
  VectorXd result = VectorXd::Zero(static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& tri = triangles[t];
    const Vec3 n = area_vectors.col(static_cast<Eigen::Index>(t)) / 12;
    const Vec3 through(n.dot(velocity.col(tri[0])), n.dot(velocity.col(tri[1])), n.dot(velocity.col(tri[2])));
    for (std::size_t a = 0; a < 3; ++a) result[tri[a]] += through.sum() + through[static_cast<Eigen::Index>(a)];
  }
  return result;
}

Points Surface::pressure_force(const VectorXd& pressure) const {
  Points result = Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& tri = triangles[t];
    const double sum = pressure[tri[0]] + pressure[tri[1]] + pressure[tri[2]];
    for (int node : tri)
      result.col(node) += (sum + pressure[node]) / 12 * area_vectors.col(static_cast<Eigen::Index>(t));
  }
  return result;
}

VectorXd Surface::flux_change(const Points& velocity, const Points& points, const Points& motion) const {
  VectorXd result = VectorXd::Zero(static_cast<Eigen::Index>(nodes.size()));
  for (const Triangle& tri : triangles) {
    const Vec3 n = area_vector_change(points, motion, tri) / 12;
    const Vec3 through(n.dot(velocity.col(tri[0])), n.dot(velocity.col(tri[1])), n.dot(velocity.col(tri[2])));
    for (std::size_t a = 0; a < 3; ++a) result[tri[a]] += through.sum() + through[static_cast<Eigen::Index>(a)];
  }
  return result;
}

Points Surface::pressure_force_change(const VectorXd& pressure, const Points& points, const Points& motion) const {
  Points result = Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  for (const Triangle& tri : triangles) {
    const Vec3 n = area_vector_change(points, motion, tri) / 12;
    const double sum = pressure[tri[0]] + pressure[tri[1]] + pressure[tri[2]];
    for (int node : tri) result.col(node) += (sum + pressure[node]) * n;
  }
  return result;
}

Points Surface::shared_by_nodes(const Points& forces) const {
  Points result = Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int node : triangles[t]) result.col(node) += forces.col(static_cast<Eigen::Index>(t)) / 3;
  return result;
}

double Surface::mean_shear(const Points& forces) const {
  double along = 0;
  for (Eigen::Index t = 0; t < forces.cols(); ++t) {
    const Vec3 normal = area_vectors.col(t).normalized();
    along += (forces.col(t) - normal.dot(forces.col(t)) * normal).norm();
  }
  return along / area();
}

double Surface::total_flux(const Points& velocity) const {
  return flux(velocity).sum();
}

double Surface::area() const {
  return area_vectors.colwise().norm().sum();
}

double Surface::mean(const VectorXd& values) const {
  double sum = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& tri = triangles[t];
    sum +=
        (values[tri[0]] + values[tri[1]] + values[tri[2]]) / 3 * area_vectors.col(static_cast<Eigen::Index>(t)).norm();
  }
  return sum / area();
}

double Surface::enclosed(const Points& points) const {
  double sum = 0;
  for (const auto& tri : triangles)
    sum += (points.col(tri[0]) + points.col(tri[1]) + points.col(tri[2])).dot(area_vector(points, tri)) / 9;
  return sum;
}

}  // namespace tether::fluid
