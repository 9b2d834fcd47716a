#include "fluid/mesh_motion.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "fluid/geometry.hpp"

namespace tether::fluid {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// 1/V int grad phi_a . grad phi_b.
double harmonic_entry(const TetGeometry& g, int a, int b) {
  return g.grad_N.col(a).dot(g.grad_N.col(b));
}

/// 1/V int (lambda div phi_a div phi_b + 2 mu eps(phi_a) : eps(phi_b)) for Young's modulus 1, nu = 0.3.
Mat3 elastic_block(const TetGeometry& g, int a, int b) {
  constexpr double nu = 0.3, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu));
  const Vec3 ga = g.grad_N.col(a), gb = g.grad_N.col(b);
  return lambda * ga * gb.transpose() + mu * (gb * ga.transpose() + ga.dot(gb) * Mat3::Identity());
}

/// Calls entry(row node, column node, a, b, geometry) for every pair of nodes of every element with an own node.
template <class Entry>
void for_each_pair(const FluidMesh& mesh, const Share& share, const Entry& entry) {
  for (const auto& tet : mesh.tetrahedra) {
    if (std::none_of(tet.begin(), tet.end(), [&share](int node) { return share.is_own(node); })) continue;
    const TetGeometry g = tet_geometry(gather(mesh.points, tet));
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) entry(tet[static_cast<std::size_t>(a)], tet[static_cast<std::size_t>(b)], a, b, g);
  }
}

Share share_of(const std::vector<int>& nodes, const Share& share) {
  if (share.is_whole()) return Share(static_cast<int>(nodes.size()));
  std::vector<int> owner;
  for (int node : nodes) owner.push_back(share.owner(node));
  return Share(share.team(), std::move(owner));
}

/// Of a mesh with so many nodes, those that are not in the list.
std::vector<int> other_nodes(const std::vector<int>& nodes, Eigen::Index count) {
  std::vector<char> listed(static_cast<std::size_t>(count), 0);
  for (int node : nodes) listed[static_cast<std::size_t>(node)] = 1;
  std::vector<int> others;
  for (std::size_t node = 0; node < listed.size(); ++node)
    if (listed[node] == 0) others.push_back(static_cast<int>(node));
  return others;
}

Eigen::MatrixXd as_unknowns(const Points& points, int components) {
  if (components == 1) return points.transpose();
  return points.reshaped();
}

Points as_points(const Eigen::MatrixXd& unknowns, int components) {
  if (components == 1) return unknowns.transpose();
  return unknowns.reshaped(3, unknowns.size() / 3);
}

}  // namespace

MeshMotionKind mesh_motion_named(const std::string& name) {
  if (name == "harmonic") return MeshMotionKind::harmonic;
  if (name == "elastic") return MeshMotionKind::elastic;
  throw input_error("mesh motion \"{}\" is neither harmonic nor elastic", name);
}

MeshMotion::MeshMotion(const FluidMesh& mesh, std::vector<int> boundary_nodes, MeshMotionKind kind, const Share& share)
    : boundary_(std::move(boundary_nodes)),
      inner_(other_nodes(boundary_, mesh.points.cols())),
      components_(kind == MeshMotionKind::harmonic ? 1 : 3),
      share_(share_of(inner_, share)) {
  const auto of_boundary = [](int number) { return -2 - number; };  // its own inverse
  // Of each node: its number among the inner ones, from 0, or of_boundary of that among the boundary's.
  std::vector<int> place(static_cast<std::size_t>(mesh.points.cols()));
  for (std::size_t i = 0; i < boundary_.size(); ++i)
    place[static_cast<std::size_t>(boundary_[i])] = of_boundary(static_cast<int>(i));
  for (std::size_t i = 0; i < inner_.size(); ++i) place[static_cast<std::size_t>(inner_[i])] = static_cast<int>(i);

  const int c = components_;
  Triplets inner, coupling;
  for_each_pair(mesh, share, [&](int row_node, int column_node, int a, int b, const TetGeometry& g) {
    const int row = place[static_cast<std::size_t>(row_node)], column = place[static_cast<std::size_t>(column_node)];
    if (row < 0) return;
    auto& target = column >= 0 ? inner : coupling;
    const int column_number = column >= 0 ? column : of_boundary(column);
    if (c == 1) {
      target.emplace_back(row, column_number, harmonic_entry(g, a, b));
      return;
    }
    const Mat3 block = elastic_block(g, a, b);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) target.emplace_back(3 * row + i, 3 * column_number + j, block(i, j));
  });

  const auto unknowns = static_cast<Eigen::Index>(inner_.size()) * c;
  coupling_.resize(unknowns, static_cast<Eigen::Index>(boundary_.size()) * c);
  coupling_.setFromTriplets(coupling.begin(), coupling.end());
  SparseMatrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(inner.begin(), inner.end());
  if (unknowns == 0) return;
  solver_ = c == 1 ? laplacian_solver(share_) : symmetric_solver(share_);
  solver_->analyze(matrix, c);
  solver_->factor(matrix);
}

Points MeshMotion::extend(const Points& on_boundary) const {
  Points result(3, static_cast<Eigen::Index>(boundary_.size() + inner_.size()));
  result(Eigen::all, boundary_) = on_boundary;
  if (inner_.empty()) return result;
  if (on_boundary.isZero(0)) {
    result.setZero();
    return result;
  }
  Eigen::MatrixXd unknowns = -(coupling_ * as_unknowns(on_boundary, components_));
  solver_->solve_in_place(unknowns);
  result(Eigen::all, inner_) = as_points(unknowns, components_);
  return result;
}

}  // namespace tether::fluid
