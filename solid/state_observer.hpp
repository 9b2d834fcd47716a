#pragma once

#include "common/linalg/symmetric_solver.hpp"
#include "solid/wall_model.hpp"

namespace tether {

/// Distances from the interface's nodes to the data (O.1), and the areas they stand for: 0 where there is none.
struct NodalDistances {
  VectorXd weight, distance;
  Points normal;
};

/// The displacement observer (O.7): pulls the wall toward the measured lumen, dy/dt = u + Ext(gamma d). Ext(t) is the
/// static displacement of the linear elastic wall, its supports included, whose part along the imaged lumen's normals N
/// is t at the observed nodes: the e that minimises e'K e/2 + kappa/2 sum_a A_a (N_a . e_a - t_a)^2, kappa a hundred
/// times the wall's stiffness against inflation, A_a the node's area. A distance d along n asks for t = d n.N: that is
/// how far the lumen must move along N, be n the data's normal or a contour's in its slice. K + kappa A is factored
/// once; while other nodes are observed it preconditions a few conjugate gradients, and it is made anew when they
/// become many.
class StateObserver {
 public:
  /// gain: gamma of each interface node [1/time].
  StateObserver(const WallModel& model, VectorXd gain);

  /// Ext((1 - exp(-gamma dt)) d): what the gain makes of the distances in a time. One column a node of the wall. Throws
  /// RunError if the equations cannot be solved.
  Points correction(const NodalDistances& data, double dt);
  /// Ext(gamma d) [length/time] during a step of length dt. A gain above 1/(2 dt) counts as that: the turns by which
  /// drift and step find each other would not converge.
  Points drift(const NodalDistances& data, double dt);

  /// Nodes whose correction was cut to a quarter of the local mesh size, since the start.
  std::int64_t limited() const { return limited_; }

  /// What the kept factor was made from, and a mark, so that a run continues bit for bit; all zero if there is none. A
  /// mixture of states is continued with the factor at hand.
  VectorXd state() const;
  Eigen::Index state_size() const { return interface_nodes_ + 1; }
  void set_state(const VectorXd& state);

 private:
  VectorXd limited(const NodalDistances& data, const VectorXd& target);
  Points extend(const NodalDistances& data, const VectorXd& target);
  VectorXd observed_area(const NodalDistances& data) const;
  VectorXd times(const VectorXd& observed, const VectorXd& e) const;
  void factor(const VectorXd& observed);

  const Share& share_;
  Eigen::Index interface_nodes_;
  VectorXd gain_, mesh_size_;
  SparseMatrix K_;
  double kappa_;
  Points normal_;  ///< N of each interface node
  VectorXd area_;  ///< A; 0 of nodes that cannot move or have no gain
  std::unique_ptr<SymmetricSolver> factor_;
  VectorXd factored_;  ///< area of each node observed when the factor was made; empty: there is none
  std::int64_t limited_ = 0;
};

}  // namespace tether
