#include "fluid/probe.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

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

/// Places sorted along x, so that those in a box are found fast.
class SortedPlaces {
 public:
  explicit SortedPlaces(const Points& places) : places_(places), order_(static_cast<std::size_t>(places.cols())) {
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(),
              [&](Eigen::Index a, Eigen::Index b) { return places(0, a) < places(0, b); });
  }
  template <class Visit>
  void in_box(const Vec3& low, const Vec3& high, const Visit& visit) const {
    auto first = std::lower_bound(order_.begin(), order_.end(), low[0],
                                  [this](Eigen::Index i, double x) { return places_(0, i) < x; });
    for (; first != order_.end() && places_(0, *first) <= high[0]; ++first)
      if (const auto x = places_.col(*first).array(); (x >= low.array()).all() && (x <= high.array()).all())
        visit(*first);
  }

 private:
  const Points& places_;
  std::vector<Eigen::Index> order_;
};

}  // namespace

Points vectors_in_space(const Points& places, const Points& points, const std::vector<Tetrahedron>& tetrahedra,
                        const Points& field) {
  Points result = Points::Constant(3, places.cols(), std::numeric_limits<double>::quiet_NaN());
  const SortedPlaces sorted(places);
  for (const Tetrahedron& tetrahedron : tetrahedra) {
    const Nodal corners = gather(points, tetrahedron);
    const Vec3 low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff(),
               margin = rounding * (high - low);
    sorted.in_box(low - margin, high + margin, [&](Eigen::Index i) {
      const Eigen::Vector4d weights = barycentric(places.col(i), corners);
      if (weights.minCoeff() >= -rounding) result.col(i) = gather(field, tetrahedron) * weights;
    });
  }
  return result;
}

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
