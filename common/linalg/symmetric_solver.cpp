#include "common/linalg/symmetric_solver.hpp"

#include <dlfcn.h>

#include "common/base/error.hpp"
#include "common/linalg/cholesky.hpp"
#include "common/linalg/shared_solver.hpp"

namespace tether {
namespace {

/// PETSc is loaded where it is used: to load it takes longer than a small model's first steps.
MakeSharedSolver* shared_solvers() {
  void* library = dlopen(shared_solver_file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw input_error("coupling.ranks: Tether's own programs need PETSc to run in several processes ({})", dlerror());
  return reinterpret_cast<MakeSharedSolver*>(dlsym(library, shared_solver_function));
}

}  // namespace

void SymmetricSolver::factor(const SparseMatrix& matrix) {
  if (!factor_if_definite(matrix)) throw run_error("a matrix that should be positive definite is not");
}

VectorXd SymmetricSolver::solve(const VectorXd& rhs) const {
  Eigen::MatrixXd x = rhs;
  solve_in_place(x);
  return x.col(0);
}

std::unique_ptr<SymmetricSolver> symmetric_solver(const Share& share) {
  if (share.is_whole()) return std::make_unique<Cholesky>();
  static MakeSharedSolver* const make = shared_solvers();
  return std::unique_ptr<SymmetricSolver>(make(share));
}

}  // namespace tether
