#pragma once

#include <vector>

#include "fluid/end_face.hpp"
#include "fluid/geometry.hpp"
#include "fluid/mesh_motion.hpp"

namespace tether::fluid {

/// The moving lumen: the reference mesh, the pieces of its boundary, and where they stand now.
class FluidDomain {
 public:
  /// Throws InputError if inlets and outlets touch, or lack a rim.
  FluidDomain(FluidMesh mesh, MeshMotionKind motion);

  const FluidMesh& mesh() const { return mesh_; }
  int node_count() const { return static_cast<int>(mesh_.points.cols()); }
  const std::vector<Tetrahedron>& tetrahedra() const { return mesh_.tetrahedra; }

  Surface sigma;  ///< the interface
  std::vector<EndFace> inlets, outlets;

  /// Displacement of all nodes from that of Sigma (local): rims, then end faces, then the inside. (F.1)
  Points extend(const Points& on_sigma) const;
  /// The mesh stands at reference + displacement. Throws RunError if an element folds; the placement is then unusable
  /// until the next call.
  void place(const Points& displacement);
  /// Of every element, where the mesh stands now.
  const std::vector<TetGeometry>& geometry() const { return geometry_; }
  /// Volume of the lumen whose interface stands at reference + on_sigma, by its surface.
  double volume(const Points& on_sigma) const;
  double smallest_jacobian() const { return worst_element(geometry_, reference_volumes_).ratio; }

 private:
  /// Displacement of all boundary nodes (zero elsewhere).
  Points on_boundary(const Points& on_sigma) const;

  FluidMesh mesh_;
  MeshMotion motion_;
  std::vector<double> reference_volumes_;
  std::vector<TetGeometry> geometry_;
};

}  // namespace tether::fluid
