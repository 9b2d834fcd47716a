#pragma once

#include <memory>

#include "common/linalg/symmetric_solver.hpp"

namespace tether {

/// Sparse Cholesky factorisation (CHOLMOD, supernodal, one BLAS thread). The ordering is found once, on the graph of
/// nodes when unknowns come in blocks; `factor` may be called again with new values.
class Cholesky final : public SymmetricSolver {
 public:
  Cholesky();
  ~Cholesky() override;
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  void analyze(const SparseMatrix& matrix, int components = 1) override;
  bool factor_if_definite(const SparseMatrix& matrix) override;
  /// The factor is kept in single precision, in half the memory and at half of what a solve costs, which is to read it.
  /// Solves are then wrong by 1e-7 times the condition of the matrix; if one of them is found to be by more than
  /// `tolerance`, relatively, the factor stays as it is.
  bool factor_roughly(const SparseMatrix& matrix, double tolerance) override;
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const override;

  bool has_factor() const override;
  double factor_megabytes() const override;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace tether
