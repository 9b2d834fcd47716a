#pragma once

#include <memory>

#include "common/base/types.hpp"
#include "common/linalg/share.hpp"
#include "common/linalg/sparse.hpp"

namespace tether {

/// Solves with one symmetric positive definite matrix after another of the same pattern.
class SymmetricSolver {
 public:
  virtual ~SymmetricSolver() = default;

  /// Orders and analyses the pattern. components: unknowns per node, numbered node-wise. Throws RunError.
  virtual void analyze(const SparseMatrix& matrix, int components = 1) = 0;
  /// Same pattern as analyzed. Returns whether the matrix is positive definite. If it is not, there is nothing to solve
  /// with.
  virtual bool factor_if_definite(const SparseMatrix& matrix) = 0;
  /// The same, to precondition with: cheaper, at solves that are wrong by at most `tolerance`, relatively.
  virtual bool factor_roughly(const SparseMatrix& matrix, double tolerance) = 0;
  /// rhs: one column or several; overwritten by the solution.
  virtual void solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const = 0;

  /// What is kept of earlier matrices to save time is kept no longer: what follows depends on the next one alone.
  virtual void forget() {}

  virtual bool has_factor() const = 0;
  /// Of this process.
  virtual double factor_megabytes() const = 0;

  /// Throws RunError if the matrix is not positive definite.
  void factor(const SparseMatrix& matrix);
  VectorXd solve(const VectorXd& rhs) const;

 protected:
  /// Whether one solve, with no structure that a factor could be good at by chance, is wrong by at most that much.
  bool solves_within(double tolerance, const SparseMatrix& matrix) const;
};

/// Direct. Of a shared matrix the rows of own nodes count, and the solution is complete. The share must outlive the
/// solver.
std::unique_ptr<SymmetricSolver> symmetric_solver(const Share& share);
/// Unknowns above which cycles of multigrid take less than a factor and its solves, and far less memory: a factor of a
/// mesh in three dimensions grows as the square of the nodes, in work. (docs/decisions/0125-several-processes.md)
inline constexpr int most_factored = 250'000;
/// The same for Laplacians in three dimensions: shared by several processes, and with more unknowns than `most`, they
/// are solved by multigrid. Throws RunError if PETSc cannot be loaded.
std::unique_ptr<SymmetricSolver> laplacian_solver(const Share& share, int most = most_factored);

}  // namespace tether
