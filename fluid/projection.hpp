#pragma once

#include <span>
#include <vector>

#include "common/linalg/symmetric_solver.hpp"
#include "fluid/fluid_domain.hpp"

namespace tether::fluid {

/// Steps 4 and 5 of the scheme: the pressure, together with what stands behind the openings. (F.8)
///   (dt/rho) (grad p, grad q) + sum_i (p_i - known_i)/Z_i q_i = rhs(q)
/// for all q that are constant on each opening i, its rim included: one tied unknown each. Symmetric positive definite
/// as long as there is one opening.
class Projection {
 public:
  /// openings: the nodes of each, disjoint; there must be at least one.
  Projection(const FluidDomain& domain, const std::vector<std::vector<int>>& openings);

  /// Assembles and factors where the mesh stands now. impedances: Z of each opening, 0 where its pressure is
  /// prescribed.
  void factor(const FluidDomain& domain, double dt_over_rho, std::span<const double> impedances);

  struct Solution {
    VectorXd pressure;  ///< at all nodes
    VectorXd flow;      ///< out through each opening, relative to it where rhs holds its sweeping: the row's remainder
  };
  /// rhs: at all nodes. known: pressure at zero flow of each opening.
  Solution solve(const VectorXd& rhs, const VectorXd& known) const;

  /// Of the meshes that it has seen: what follows is as if the next one were the first.
  void forget() { solver_->forget(); }

  double megabytes() const { return solver_->factor_megabytes(); }

 private:
  using Row = std::vector<std::pair<int, double>>;

  void number(const FluidDomain& domain, const std::vector<std::vector<int>>& openings);
  void assemble(const FluidDomain& domain, double dt_over_rho);
  Row row_of_opening(int row) const;
  int opening_unknown(std::size_t i) const { return unknowns_ - static_cast<int>(openings_) + static_cast<int>(i); }

  std::size_t openings_;
  int unknowns_ = 0;
  std::vector<int> unknown_of_;  // node -> unknown; those of the openings come last
  ScatterMap map_;
  SparseMatrix matrix_;
  Share share_;  // of the unknowns
  std::unique_ptr<SymmetricSolver> solver_;
  std::vector<double> impedances_;
  std::vector<Row> rows_;  // (dt/rho) Laplacian of each opening's unknown at this process's unknowns, before its
                           // impedance entered
};

}  // namespace tether::fluid
