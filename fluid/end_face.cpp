#include "fluid/end_face.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include <algorithm>

#include "common/base/error.hpp"

namespace tether::fluid {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using ComplexSparse = Eigen::SparseMatrix<std::complex<double>>;

/// Rows and columns of a matrix that belong to the listed unknowns.
Sparse block(const Sparse& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<int> row_place(static_cast<std::size_t>(matrix.rows()), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) row_place[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (Sparse::InnerIterator entry(matrix, columns[j]); entry; ++entry)
      if (const int i = row_place[static_cast<std::size_t>(entry.row())]; i >= 0)
        entries.emplace_back(i, static_cast<int>(j), entry.value());
  Sparse result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Stiffness (grad phi_a, grad phi_b) of a triangle in space with corners x.
Mat3 triangle_stiffness(const Mat3& x, double area) {
  Mat3 opposite;  // edge opposite to each node: |grad phi_a| = |edge_a| / (2 area), at right angles to it
  for (int a = 0; a < 3; ++a) opposite.col(a) = x.col((a + 2) % 3) - x.col((a + 1) % 3);
  return opposite.transpose() * opposite / (4 * area);
}

}  // namespace

struct EndFace::Extension {
  Sparse coupling;  // inner rows, rim columns
  Eigen::SimplicialLDLT<Sparse> inner;
};

EndFace::EndFace(const Patch& patch, const FluidMesh& mesh, const std::vector<int>& sigma_nodes)
    : Surface(patch.triangles, mesh), name(patch.name), extension_(std::make_unique<Extension>()) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    (std::binary_search(sigma_nodes.begin(), sigma_nodes.end(), nodes[i]) ? rim : inner).push_back(static_cast<int>(i));
  if (rim.empty()) throw input_error("face \"{}\" of the fluid mesh has no rim on the interface", name);
  if (inner.empty())
    throw input_error("face \"{}\" of the fluid mesh has no node inside its rim: refine the mesh", name);

  const auto count = static_cast<Eigen::Index>(nodes.size());
  const Points x = local(mesh.points);
  lumped_ = VectorXd::Zero(count);
  std::vector<Eigen::Triplet<double>> stiffness, mass;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& tri = triangles[t];
    const double area = area_vectors.col(static_cast<Eigen::Index>(t)).norm();
    const Mat3 k = triangle_stiffness(x(Eigen::all, tri), area);
    for (int a = 0; a < 3; ++a) {
      const int row = tri[static_cast<std::size_t>(a)];
      lumped_[row] += area / 3;
      for (int b = 0; b < 3; ++b) {
        stiffness.emplace_back(row, tri[static_cast<std::size_t>(b)], k(a, b));
        mass.emplace_back(row, tri[static_cast<std::size_t>(b)], area / (a == b ? 6 : 12));
      }
    }
  }
  stiffness_.resize(count, count);
  stiffness_.setFromTriplets(stiffness.begin(), stiffness.end());
  mass_.resize(count, count);
  mass_.setFromTriplets(mass.begin(), mass.end());
  extension_->coupling = block(stiffness_, inner, rim);
  extension_->inner.compute(block(stiffness_, inner, inner));
}

EndFace::~EndFace() = default;
EndFace::EndFace(EndFace&&) noexcept = default;

void EndFace::extend_from_rim(Points& field) const {
  const Eigen::MatrixXd on_rim = field(Eigen::all, rim).transpose();
  const Eigen::MatrixXd inside = extension_->inner.solve(-(extension_->coupling * on_rim));
  field(Eigen::all, inner) = inside.transpose();
}

Eigen::VectorXcd EndFace::developed_profile(std::complex<double> alpha) const {
  const ComplexSparse matrix = block(stiffness_, inner, inner).cast<std::complex<double>>() +
                               alpha * block(mass_, inner, inner).cast<std::complex<double>>();
  Eigen::SparseLU<ComplexSparse> solver(matrix);
  const Eigen::VectorXcd load = lumped_(inner).cast<std::complex<double>>();
  Eigen::VectorXcd psi = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(nodes.size()));
  const Eigen::VectorXcd inside = solver.solve(load);
  psi(inner) = inside;
  return psi;
}

std::complex<double> EndFace::integral(const Eigen::VectorXcd& psi) const {
  return lumped_.cast<std::complex<double>>().dot(psi);  // conjugates its left side, which is real
}

}  // namespace tether::fluid
