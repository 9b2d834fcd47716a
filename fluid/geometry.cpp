#include "fluid/geometry.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace tether::fluid {
namespace {

/// Below this ratio an element is as good as folded: gradients grow as its inverse.
constexpr double smallest_ratio = 0.01;

}  // namespace

TetGeometry tet_geometry(const Nodal& x) {
  const Vec3 a = x.col(1) - x.col(0), b = x.col(2) - x.col(0), c = x.col(3) - x.col(0);
  TetGeometry result;
  result.grad_N.col(1) = b.cross(c);
  result.grad_N.col(2) = c.cross(a);
  result.grad_N.col(3) = a.cross(b);
  const double determinant = a.dot(result.grad_N.col(1));
  result.grad_N.rightCols<3>() /= determinant;
  result.grad_N.col(0) = -(result.grad_N.col(1) + result.grad_N.col(2) + result.grad_N.col(3));
  result.volume = determinant / 6;
  return result;
}

void set_geometry(std::vector<TetGeometry>& geometry, const Points& points,
                  const std::vector<Tetrahedron>& tetrahedra) {
  geometry.resize(tetrahedra.size());
  for (std::size_t e = 0; e < tetrahedra.size(); ++e) geometry[e] = tet_geometry(gather(points, tetrahedra[e]));
}

std::vector<TetGeometry> geometry_of(const Points& points, const std::vector<Tetrahedron>& tetrahedra) {
  std::vector<TetGeometry> result;
  set_geometry(result, points, tetrahedra);
  return result;
}

WorstElement worst_element(const std::vector<TetGeometry>& now, const std::vector<double>& reference_volumes) {
  WorstElement worst;
  for (std::size_t e = 0; e < now.size(); ++e)
    if (const double ratio = now[e].volume / reference_volumes[e]; !(ratio >= worst.ratio)) worst = {e, ratio};
  return worst;
}

bool is_sound(double ratio) {
  return ratio >= smallest_ratio;
}

std::string folded_text(int element, const Nodal& corners, double ratio) {
  const Vec3 centre = corners.rowwise().mean();
  return fmt::format(
      "the fluid mesh breaks: element {} at ({:.4g}, {:.4g}, {:.4g}) has {:.3g} of its reference volume (at least {} "
      "is needed)",
      element, centre.x(), centre.y(), centre.z(), ratio, smallest_ratio);
}

Points gradient(const std::vector<TetGeometry>& geometry, const std::vector<Tetrahedron>& tetrahedra,
                const VectorXd& scalar) {
  Points result(3, static_cast<Eigen::Index>(tetrahedra.size()));
  for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
    const auto& tet = tetrahedra[e];
    const Eigen::Vector4d values(scalar[tet[0]], scalar[tet[1]], scalar[tet[2]], scalar[tet[3]]);
    result.col(static_cast<Eigen::Index>(e)) = geometry[e].grad_N * values;
  }
  return result;
}

}  // namespace tether::fluid
