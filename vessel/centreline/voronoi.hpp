#pragma once

#include "vessel/surface/surface.hpp"

namespace tether {

/// Centres of the largest empty spheres among a wall's nodes, inside it, and which are neighbours: the Voronoi
/// diagram's inner part.
struct VoronoiGraph {
  struct Link {
    int to;
    double cost;  ///< length over radius
  };
  std::vector<Vec3> centres;  ///< [cm]
  std::vector<double> radii;  ///< [cm]
  std::vector<std::vector<Link>> links;
};
VoronoiGraph voronoi_graph(const LabelledSurface& surface);

/// Distances to a surface's wall.
class WallDistance {
 public:
  explicit WallDistance(const LabelledSurface& surface);
  ~WallDistance();
  double operator()(const Vec3& x) const;  ///< [cm]

 private:
  struct Tree;
  Tree* tree_;
};

}  // namespace tether
