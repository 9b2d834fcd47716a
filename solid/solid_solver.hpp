#pragma once

#include "common/base/mark.hpp"
#include "common/linalg/krylov.hpp"
#include "common/linalg/symmetric_solver.hpp"
#include "solid/wall_model.hpp"

namespace tether {

/// Displacement y1 and velocity V = (y1 - y0)/dt of the interface, one column a node.
struct InterfaceMotion {
  Points displacement, velocity;
};

/// The wall in time: midpoint rule (S.5), unknown V on all nodes. The interface's nodes come first.
/// A step: begin_step, then either `evaluate` (black box) or `residual`, `product`, `precondition` (open), then accept
/// or rewind.
class SolidSolver {
 public:
  explicit SolidSolver(WallModel& model);

  /// The step from `time` to `time + dt`. The first iterate is the velocity of the last accepted step.
  void begin_step(double time, double dt);

  /// Add `correction` (empty: none) to the iterate and return load - forces, zero on clamped unknowns (S.5). `load`: 3
  /// x interface nodes.
  VectorXd residual(const VectorXd& correction, const Points& load);
  /// Tangent of the forces at the iterate (at the second evaluation of a step still that of the first) times a
  /// direction: symmetric positive definite.
  VectorXd product(const VectorXd& direction);
  /// A kept factor's solve: close to the inverse of `product`; zero on clamped unknowns.
  VectorXd precondition(const VectorXd& residual);

  /// Solve the step under the load by Newton; each correction by conjugate gradients with the kept factor (S.11).
  /// Throws RunError if it fails.
  InterfaceMotion evaluate(const Points& load);
  /// The same, linearised at the last evaluation.
  InterfaceMotion tangent(const Points& load_change);

  InterfaceMotion interface_motion() const;

  /// Beside the wall's own motion every node moves with this rate during the step begun, dy/dt = u + rate, until the
  /// next begin_step (O.9).
  void set_drift(const Points& rate);
  /// Between two steps: a change of the displacement that is no motion.
  void displace(const Points& change);

  void accept();
  void rewind();

  const Points& displacement() const { return displacement_; }  ///< of the last accepted step
  const Points& velocity() const { return velocity_; }          ///< u of the last accepted step
  /// Force of each support on the wall at the end of the last accepted step.
  std::vector<Vec3> support_forces() const;
  /// Largest displacement of a node in the last accepted step [length].
  double largest_displacement() const { return displacement_.colwise().norm().maxCoeff(); }

  /// Everything needed to continue bit for bit: y, u, V of the last step, and what the kept factor was made from, with
  /// a mark by which a mixture of states is told from a state: it is continued with the factor at hand, at no cost. So
  /// is the state of a wall of the same nodes with other parameters, whose length may be another. Throws InputError for
  /// one of other nodes.
  VectorXd state() const;
  Eigen::Index state_size() const;
  void set_state(const VectorXd& state);

 private:
  /// What a factor was made from: it can be made again, bit for bit.
  struct FactorOrigin {
    Points displacement;
    double time = 0;  ///< when supports stood as they did
    double dt = 0;    ///< 0: there is no factor yet
    std::vector<double> parameters;
    double steps = 0;               ///< with corrections, since it is there
    double calls = 0, decades = 0;  ///< of `precondition` in the first of them, and the powers of ten they removed
    double lost = 0;                ///< calls more than those needed for as much, since
    void count(int calls, double decades);
    bool makes_same_factor_as(const FactorOrigin& other) const;
  };

  /// Differs for any other displacement, dt, parameters or names of them.
  double mark_of(const FactorOrigin& origin) const;
  void place_driven();
  /// load - forces at the iterate, zero on clamped unknowns.
  VectorXd out_of_balance(const Points& load, bool renew_tangent);
  const SparseMatrix& current_tangent();
  void assemble_tangent();
  void assemble_tangent_at(const FactorOrigin& origin);
  void make_factor(const FactorOrigin& origin);
  void factor_tangent();
  void renew_factor_if_stale();
  void restore_factor(const FactorOrigin& origin);
  KrylovResult solve_linear(const VectorXd& rhs, VectorXd& x, double tolerance);
  InterfaceMotion interface_part(const VectorXd& velocity) const;
  Points drifted_start() const;

  WallModel& model_;
  Mark nodes_;                                      ///< of the mesh
  Points displacement_, velocity_, mean_velocity_;  ///< y, u at the start of the step; V of the last accepted step
  Points drift_;
  Points iterate_;  ///< V
  double time_ = 0, dt_ = 0;
  SparseMatrix tangent_;
  bool tangent_serves_ = false;
  std::unique_ptr<SymmetricSolver> factor_;
  FactorOrigin origin_;
  int evaluations_ = 0;
  int calls_ = 0, calls_for_last_ = 0;  ///< of `precondition` for corrections: so far, and up to the last estimate
  double first_estimate_ = 0, last_estimate_ = 0;  ///< |M r| at the step's first and latest iterate
  bool estimates_ = false;                         ///< the next call of `precondition` is one
};

}  // namespace tether
