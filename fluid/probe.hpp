#pragma once

#include <string>

#include "common/mesh/mesh.hpp"

namespace tether::fluid {

/// A place in the blood where the pressure is reported. It moves with the mesh: it keeps its place in its tetrahedron.
struct Probe {
  std::string name;
  Tetrahedron tetrahedron{};                               ///< nodes of the one that holds it in the reference mesh
  Eigen::Vector4d weights = Eigen::Vector4d::Constant(0);  ///< barycentric coordinates in it

  /// Of a nodal field, at this place.
  double value(const VectorXd& field) const;
};

/// Throws InputError with the distance from the lumen's surface if no tetrahedron of the mesh holds the position.
Probe place_probe(const std::string& name, const Vec3& position, const FluidMesh& mesh);

/// A nodal vector field at places of space (3 x n), in the mesh whose nodes stand at `points`; NaN outside of it.
Points vectors_in_space(const Points& places, const Points& points, const std::vector<Tetrahedron>& tetrahedra,
                        const Points& field);

}  // namespace tether::fluid
