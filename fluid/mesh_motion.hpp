#pragma once

#include <Eigen/SparseCore>

#include <string>

#include "common/linalg/symmetric_solver.hpp"
#include "common/mesh/mesh.hpp"

namespace tether::fluid {

/// How the inside of the fluid mesh follows its boundary. Both on the reference mesh, so that the matrix is factored
/// once. (F.1)
enum class MeshMotionKind {
  harmonic,  ///< each component by a Laplacian weighted with 1/volume: small elements keep their shape. N unknowns, 3
             ///< solves
  elastic,   ///< linear elasticity, Young's modulus 1/volume, nu = 0.3: 3 N coupled unknowns
};

/// "harmonic" or "elastic". Throws InputError.
MeshMotionKind mesh_motion_named(const std::string& name);

/// d = Ext(d on the boundary nodes). (F.1)
class MeshMotion {
 public:
  /// boundary_nodes: ascending; their displacement is given, that of all others follows.
  MeshMotion(const FluidMesh& mesh, std::vector<int> boundary_nodes, MeshMotionKind kind, const Share& share);
  MeshMotion(const MeshMotion&) = delete;
  MeshMotion& operator=(const MeshMotion&) = delete;

  const std::vector<int>& boundary_nodes() const { return boundary_; }
  /// on_boundary: one column a boundary node. Returns the displacement of all nodes.
  Points extend(const Points& on_boundary) const;

 private:
  std::vector<int> boundary_, inner_;
  int components_;                                         // 1: the three columns share a matrix; 3: coupled
  Eigen::SparseMatrix<double, Eigen::RowMajor> coupling_;  // inner rows, boundary columns
  Share share_;                                            // of the inner nodes
  std::unique_ptr<SymmetricSolver> solver_;
};

}  // namespace tether::fluid
