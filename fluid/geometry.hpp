#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether::fluid {

/// A quantity of the four nodes of a tetrahedron, one column a node.
using Nodal = Eigen::Matrix<double, 3, 4>;

/// What every integral over a P1 tetrahedron needs.
struct TetGeometry {
  Nodal grad_N;       ///< column a: gradient of the shape function of node a [1/length]
  double volume = 0;  ///< signed [length^3]
};

TetGeometry tet_geometry(const Nodal& corners);

/// The columns of `field` that belong to a tetrahedron.
inline Nodal gather(const Points& field, const Tetrahedron& tet) {
  Nodal result;
  for (int a = 0; a < 4; ++a) result.col(a) = field.col(tet[static_cast<std::size_t>(a)]);
  return result;
}

/// Of all elements of a mesh whose nodes stand at `points`, into memory that is there already: a mesh moves in every
/// step.
void set_geometry(std::vector<TetGeometry>& geometry, const Points& points, const std::vector<Tetrahedron>& tetrahedra);
std::vector<TetGeometry> geometry_of(const Points& points, const std::vector<Tetrahedron>& tetrahedra);

/// The element that suffered most from the mesh motion.
struct WorstElement {
  std::size_t element = 0;
  double ratio = 1;  ///< volume now / volume in the reference mesh
};
WorstElement worst_element(const std::vector<TetGeometry>& now, const std::vector<double>& reference_volumes);

/// Whether a mesh whose worst element has this ratio is not folded, nor nearly so.
bool is_sound(double smallest_ratio);
/// What to say of a mesh that is not: its worst element, where that is, and its ratio.
std::string folded_text(int element, const Nodal& corners, double ratio);

/// Per element: the gradient of a nodal scalar, one column an element.
Points gradient(const std::vector<TetGeometry>& geometry, const std::vector<Tetrahedron>& tetrahedra,
                const VectorXd& scalar);

}  // namespace tether::fluid
