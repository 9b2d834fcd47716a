#pragma once

#include <Eigen/SparseLU>

#include <memory>
#include <vector>

#include "common/base/units.hpp"
#include "fsi_master/transfer/interface_balance.hpp"
#include "fsi_master/transfer/interface_surface.hpp"

namespace tether {

/// Shares of the interface's diagonal: nodes this near are the same; a fluid node farther from the wall belongs
/// elsewhere.
inline constexpr double same_node = 1e-5, trusted_distance = 0.02;

/// How a fluid's interface follows the solid's: v_f = H v_s. Motions go to the fluid by H, loads come back by its
/// transpose, so that force and work are the same on both sides; a surface that moves rigidly is followed rigidly, so
/// that the moment is too (C.8).
class InterfaceMap {
 public:
  /// Node for node. `units`: of these lengths, for messages. Throws InputError that counts the fluid nodes without a
  /// wall node within `tolerance` (and wall nodes without a fluid node) and locates the farthest.
  static InterfaceMap match(const InterfaceSurface& fluid, const InterfaceSurface& solid, double tolerance,
                            const UnitSystem& units);
  /// Whether each node has one of the other surface within `tolerance`, and the same nodes form triangles: nodal loads
  /// of one triangulation are not those of another, and a wall that takes them for its own ripples from node to node.
  static bool matches(const InterfaceSurface& fluid, const InterfaceSurface& solid, double tolerance);
  /// Each fluid node follows the closest place of the solid's triangles (C.10). Throws InputError if that is farther
  /// than `trust` for some node, or looks the other way.
  static InterfaceMap nearest_triangle(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust,
                                       const UnitSystem& units);
  /// The fluid's motion is that of the solid in the mean over each node's surroundings (C.11), and a load comes back as
  /// the traction that it stands for; nodes on the fluid's rims follow the closest place. Errors as above.
  static InterfaceMap mortar(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust,
                             const UnitSystem& units);

  /// Vectors node by node, v_f = H v_s and f_s = H' f_f (C.8).
  std::vector<double> to_fluid(const VectorXd& solid) const;
  VectorXd to_solid(const std::vector<double>& fluid) const;
  /// Of a fluid's load and a solid's motion, over both sides.
  InterfaceBalance balance(const std::vector<double>& load, const VectorXd& motion) const {
    return balance({load, to_fluid(motion)}, {to_solid(load), motion});
  }
  /// What was mapped already, the load and its forces, the motion and that of the fluid.
  struct AtFluid {
    std::vector<double> load, motion;
  };
  struct AtSolid {
    VectorXd forces, motion;
  };
  InterfaceBalance balance(const AtFluid& fluid, const AtSolid& solid) const;

  bool is_node_for_node() const { return node_for_node_; }
  int fluid_nodes() const { return static_cast<int>(rows_.rows() / 3); }
  int solid_nodes() const { return static_cast<int>(rows_.cols() / 3); }

 private:
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  using Mass = Eigen::SparseMatrix<double>;
  InterfaceMap(Points fluid, Points solid, const Rows& rows, std::vector<int> solved, const Mass& mass);
  /// Solves for the values of the nodes that have a mass, in place; with its transpose for loads.
  void solve_mass(Eigen::Ref<VectorXd> fluid, bool transposed) const;

  Points fluid_, solid_;  ///< in the image
  bool node_for_node_ = false;
  Rows rows_;                                    ///< 3 of each fluid node: H itself, or what the mass is solved for
  std::vector<int> solved_;                      ///< fluid nodes of the second kind
  std::unique_ptr<Eigen::SparseLU<Mass>> mass_;  ///< among them, one number a node
};

}  // namespace tether
