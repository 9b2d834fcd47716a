#pragma once

#include <array>
#include <vector>

#include "observation_manager/measurements/signed_surface.hpp"

namespace tether {

/// For each feature of a triangle the direction that tells inside from outside there (O.2), and whether it lies on an
/// open edge.
struct TriangleNormals {
  Vec3 face;
  std::array<Vec3, 3> edge;  ///< of the edge from vertex i to the next; not of unit length
  std::array<bool, 3> edge_on_rim{}, vertex_on_rim{};
};

/// Pseudonormals of all features of a surface (Baerentzen and Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 2005).
struct Pseudonormals {
  explicit Pseudonormals(const TriangleSurface& surface);
  Vec3 vertex(int node) const { return vertices.col(node); }

  std::vector<TriangleNormals> triangles;
  Points vertices;  ///< unit, weighted by the triangles' angles
};

}  // namespace tether
