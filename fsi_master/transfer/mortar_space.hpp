#pragma once

#include <Eigen/SparseCore>

#include <vector>

#include "fsi_master/transfer/interface_surface.hpp"

namespace tether {

/// What a fluid's interface is tested with (C.11): the hat functions of the nodes that are not on a rim, of which those
/// beside a rim go on to it linearly. So they add up to one everywhere and hold each linear field, and a traction is
/// handed over whole although the rim's nodes have their motion from elsewhere (as in mortar methods at a boundary with
/// given values: Wohlmuth, Discretization Methods and Iterative Solvers Based on Domain Decomposition, 2001).
class MortarSpace {
 public:
  explicit MortarSpace(const InterfaceSurface& fluid);

  bool is_rim(int node) const { return number_[static_cast<std::size_t>(node)] < 0; }
  /// Nodes that are not on a rim.
  const std::vector<int>& solved() const { return solved_; }
  /// From integrals with all hat functions to those with the test functions; three rows a node, none at rims.
  Eigen::SparseMatrix<double, Eigen::RowMajor> tests() const;
  /// Integrals of test functions and hat functions of the solved nodes, one row and one column a node [length^2].
  Eigen::SparseMatrix<double> mass() const;

 private:
  struct Share {
    int test;  ///< node whose test function it is
    double value;
  };
  /// What the test functions around a rim's node are there.
  std::vector<Share> carried_to(int rim_node, const std::vector<std::vector<int>>& neighbours,
                                const Points& normals) const;

  InterfaceSurface fluid_;
  std::vector<int> number_;  ///< of each node among the solved ones; -1: on a rim
  std::vector<int> solved_;
  std::vector<std::vector<Share>> at_;  ///< of each node: test functions that are not zero there
};

}  // namespace tether
