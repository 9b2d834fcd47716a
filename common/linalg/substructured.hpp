#pragma once

#include <memory>

#include "common/linalg/symmetric_solver.hpp"

namespace tether {

/// A direct solve shared by several processes: each eliminates the nodes inside its part of the mesh by a Cholesky
/// factor of its own (CHOLMOD), and all of them solve for those between the parts, whose matrix (the sum of the parts'
/// Schur complements) is sparse and small enough for each to have it. Sums have one order: the same number of processes
/// gives the same bits. (docs/decisions/0125-several-processes.md)
class SubstructuredSolver final : public SymmetricSolver {
 public:
  /// `share`, of the nodes, must outlive it.
  explicit SubstructuredSolver(const Share& share);
  ~SubstructuredSolver() override;

  void analyze(const SparseMatrix& matrix, int components = 1) override;
  bool factor_if_definite(const SparseMatrix& matrix) override;
  /// The factor of the part's inside is kept in single precision.
  bool factor_roughly(const SparseMatrix& matrix, double tolerance) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const override;
  bool has_factor() const override;
  double factor_megabytes() const override;

  /// Unknowns between the parts.
  Eigen::Index between() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tether
