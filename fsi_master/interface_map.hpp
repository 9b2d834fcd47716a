#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The interface as one code announces it.
struct InterfaceSurface {
  Points points;
  std::vector<Triangle> triangles;
};

/// How a fluid's interface nodes follow the solid's: each is a mean of up to three solid nodes. Motions go to the fluid
/// by these means, loads come back by the transpose, so that force and work are the same on both sides.
class InterfaceMap {
 public:
  /// Node for node. Throws InputError that counts the fluid nodes without a wall node within `tolerance` (and wall
  /// nodes without a fluid node) and locates the farthest.
  static InterfaceMap match(const InterfaceSurface& fluid, const InterfaceSurface& solid, double tolerance);
  /// Each fluid node moves with the closest point of the solid's triangles. Throws InputError if that is farther than
  /// `trust` for some node.
  static InterfaceMap nearest_triangle(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust);

  /// Vectors node by node, v_f = H v_s and f_s = H' f_f (C.8).
  std::vector<double> to_fluid(const VectorXd& solid) const;
  VectorXd to_solid(const std::vector<double>& fluid) const;
  int fluid_nodes() const { return static_cast<int>(means_.size()); }

 private:
  struct Mean {
    Triangle nodes;
    Vec3 weights;  ///< sum to 1
  };
  std::vector<Mean> means_;
  int solid_nodes_ = 0;
};

/// Diagonal of the bounding box.
double diagonal(const Points& points);

}  // namespace tether
