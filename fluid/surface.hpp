#pragma once

#include <vector>

#include "common/base/types.hpp"
#include "common/mesh/mesh.hpp"

namespace tether::fluid {

/// A piece of the fluid's boundary (Sigma, an inlet, an outlet) with its own numbering of nodes; normals out of the
/// fluid. Fields on it are `local`: one column (or entry) a node, in the order of `nodes`.
class Surface {
 public:
  Surface(const std::vector<Triangle>& triangles, const FluidMesh& mesh);

  std::vector<int> nodes;           ///< of the volume mesh, ascending
  std::vector<Triangle> triangles;  ///< local nodes
  std::vector<int> tetrahedra;      ///< the element behind each triangle
  Points area_vectors;              ///< n dA of each triangle where the mesh stands now

  /// The mesh now stands at `points` (all nodes).
  void place(const Points& points);
  /// The surface now stands at `points` (local).
  void place_locally(const Points& points);

  Points local(const Points& field) const;
  VectorXd local(const VectorXd& field) const;
  /// (B v)_a = int v.n phi_a, local v and result. (F.8)
  VectorXd flux(const Points& velocity) const;
  /// (B' p)_a = int p n phi_a, local p and result: the transpose of `flux`. (F.10)
  Points pressure_force(const VectorXd& pressure) const;
  /// Change of flux(velocity) and of pressure_force(pressure) when the surface, at `points` (local), moves. (F.11)
  VectorXd flux_change(const Points& velocity, const Points& points, const Points& motion) const;
  Points pressure_force_change(const VectorXd& pressure, const Points& points, const Points& motion) const;
  /// A third of each triangle's force to each of its nodes; forces: [3 x t], result local.
  Points shared_by_nodes(const Points& forces) const;
  /// Mean size of what such forces are along the surface, per area. (F.18)
  double mean_shear(const Points& forces) const;
  double total_flux(const Points& velocity) const;
  double area() const;
  double mean(const VectorXd& values) const;
  /// This surface's share of the volume it encloses with others, its nodes at `points` (local): int x.n / 3.
  double enclosed(const Points& points) const;
};

}  // namespace tether::fluid
