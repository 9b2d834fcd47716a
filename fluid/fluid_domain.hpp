#pragma once

#include <vector>

#include "common/linalg/share.hpp"
#include "fluid/end_face.hpp"
#include "fluid/geometry.hpp"
#include "fluid/mesh_motion.hpp"

namespace tether::fluid {

/// The moving lumen: the reference mesh, the pieces of its boundary, and where they stand now. Of its elements a
/// process holds those at its own nodes; mesh, boundary and nodal fields are whole in each.
class FluidDomain {
 public:
  /// Throws InputError if inlets and outlets touch, or lack a rim.
  FluidDomain(FluidMesh mesh, MeshMotionKind motion, Team& team = alone());
  FluidDomain(const FluidDomain&) = delete;
  FluidDomain& operator=(const FluidDomain&) = delete;

  const FluidMesh& mesh() const { return mesh_; }
  int node_count() const { return static_cast<int>(mesh_.points.cols()); }
  /// Of the nodes; those of one end belong to one process.
  const Share& share() const { return share_; }
  /// The elements that this process holds: all, if it is alone.
  const std::vector<Tetrahedron>& tetrahedra() const { return share_.is_whole() ? mesh_.tetrahedra : here_; }
  /// The place among these of an element of the mesh; -1 if this process does not hold it.
  int place_of(int element) const;

  Surface sigma;  ///< the interface
  std::vector<EndFace> inlets, outlets;

  /// Displacement of all nodes from that of Sigma (local): rims, then end faces, then the inside. (F.1)
  Points extend(const Points& on_sigma) const;
  /// The mesh stands at reference + displacement. Throws RunError if an element folds; the placement is then unusable
  /// until the next call.
  void place(const Points& displacement);
  /// Of every element that this process holds, where the mesh stands now.
  const std::vector<TetGeometry>& geometry() const { return geometry_; }
  /// Volume of the lumen whose interface stands at reference + on_sigma, by its surface.
  double volume(const Points& on_sigma) const;
  double smallest_jacobian() const;

 private:
  /// Displacement of all boundary nodes (zero elsewhere).
  Points on_boundary(const Points& on_sigma) const;
  void check_jacobians(const Points& points) const;

  FluidMesh mesh_;
  Share share_;
  std::vector<int> numbers_;       ///< in the mesh, of the elements held; empty if this process is alone
  std::vector<Tetrahedron> here_;  ///< those elements
  MeshMotion motion_;
  std::vector<double> reference_volumes_;
  std::vector<TetGeometry> geometry_;
};

}  // namespace tether::fluid
