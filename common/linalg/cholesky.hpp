#pragma once

#include <memory>

#include "common/base/types.hpp"
#include "common/linalg/sparse.hpp"

namespace tether {

/// Sparse Cholesky factorisation of a symmetric positive definite matrix (CHOLMOD, supernodal, one BLAS thread).
/// The ordering is found once, on the graph of nodes when unknowns come in blocks; `factor` may be called again with
/// new values.
class Cholesky {
 public:
  Cholesky();
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Orders and analyses the pattern. components: unknowns per node, numbered node-wise. Throws RunError.
  void analyze(const SparseMatrix& matrix, int components = 1);
  /// Same pattern as analyzed. Throws RunError if the matrix is not positive definite.
  void factor(const SparseMatrix& matrix);
  /// The same; returns whether the matrix is positive definite. If it is not, there is nothing to solve with.
  bool factor_if_definite(const SparseMatrix& matrix);
  /// The same, to precondition with: the factor is kept in single precision, in half the memory and at half of what a
  /// solve costs, which is to read it. Solves are then wrong by 1e-7 times the condition of the matrix; if one of them
  /// is found to be by more than `tolerance`, relatively, the factor stays as it is.
  bool factor_roughly(const SparseMatrix& matrix, double tolerance);
  /// rhs: one column or several; overwritten by the solution.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const;
  VectorXd solve(const VectorXd& rhs) const;

  bool has_factor() const;
  double factor_megabytes() const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace tether
