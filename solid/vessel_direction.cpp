#include "solid/vessel_direction.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/base/error.hpp"
#include "common/linalg/cholesky.hpp"
#include "common/linalg/sparse.hpp"

namespace tether {
namespace {

/// (grad phi, grad psi) of linear tetrahedra.
SparseMatrix laplacian(const Points& x, const std::vector<Tetrahedron>& cells) {
  const ScatterMap scatter(static_cast<int>(x.cols()), 1, std::span<const Tetrahedron>(cells));
  SparseMatrix K = scatter.zero_matrix();
  for (std::size_t e = 0; e < cells.size(); ++e) {
    Mat3 edges;
    for (std::size_t i = 0; i < 3; ++i)
      edges.col(static_cast<Eigen::Index>(i)) = x.col(cells[e][i + 1]) - x.col(cells[e][0]);
    Eigen::Matrix<double, 4, 3> gradient;
    gradient.bottomRows<3>() = edges.inverse();
    gradient.row(0) = -gradient.bottomRows<3>().colwise().sum();
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block =
        std::abs(edges.determinant()) / 6 * gradient * gradient.transpose();
    scatter.add(K, e, block.data());
  }
  return K;
}

}  // namespace

VectorXd place_along_vessel(const WallMesh& mesh) {
  if (mesh.rings.size() < 2)
    throw input_error("the direction along the vessel needs a wall with two end rings or more; this one has {}",
                      mesh.rings.size());
  VectorXd place = VectorXd::Zero(mesh.points.cols());
  std::vector<int> held = nodes_of(mesh.rings[0].triangles);
  for (std::size_t ring = 1; ring < mesh.rings.size(); ++ring)
    for (const int node : nodes_of(mesh.rings[ring].triangles)) {
      place[node] = 1;
      held.push_back(node);
    }
  SparseMatrix K = laplacian(mesh.points, mesh.prisms.empty() ? mesh.tetrahedra : split_into_tetrahedra(mesh.prisms));
  VectorXd rhs = -(K * place);
  for (const int node : held) rhs[node] = 0;
  constrain(K, held, K.coeff(0, 0));
  Cholesky factor;
  factor.analyze(K);
  factor.factor(K);
  return place + factor.solve(rhs);
}

Vec3 direction_on(const Mat3& x, const Vec3& values) {
  const Vec3 a = x.col(1) - x.col(0), b = x.col(2) - x.col(0), n = a.cross(b);
  return ((values[1] - values[0]) * b.cross(n) + (values[2] - values[0]) * n.cross(a)).normalized();
}

}  // namespace tether
