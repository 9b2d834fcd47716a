#include "common/linalg/symmetric_solver.hpp"

#include <dlfcn.h>

#include <cmath>
#include <filesystem>

#include "common/base/error.hpp"
#include "common/linalg/cholesky.hpp"
#include "common/linalg/shared_solver.hpp"
#include "common/linalg/substructured.hpp"

namespace tether {
namespace {

/// PETSc is loaded where it is used: to load it takes longer than a small model's first steps.
MakeSharedSolver* shared_solvers() {
  const auto beside = std::filesystem::read_symlink("/proc/self/exe").parent_path() / shared_solver_file;
  const bool is_there = std::filesystem::exists(beside);  // else where the loader looks
  void* library = dlopen(is_there ? beside.c_str() : shared_solver_file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw run_error("coupling.ranks: so large a mesh needs PETSc, which cannot be loaded: {}", dlerror());
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

bool SymmetricSolver::solves_within(double tolerance, const SparseMatrix& matrix) const {
  VectorXd any(matrix.rows());
  for (Eigen::Index i = 0; i < any.size(); ++i) any[i] = std::sin(static_cast<double>((i + 1) * (i + 1)));
  return (solve(matrix * any) - any).norm() <= tolerance * any.norm();
}

std::unique_ptr<SymmetricSolver> symmetric_solver(const Share& share) {
  if (share.is_whole()) return std::make_unique<Cholesky>();
  return std::make_unique<SubstructuredSolver>(share);
}

std::unique_ptr<SymmetricSolver> laplacian_solver(const Share& share, int most) {
  if (share.is_whole() || share.nodes() <= most) return symmetric_solver(share);
  static MakeSharedSolver* const make = shared_solvers();
  return std::unique_ptr<SymmetricSolver>(make(share));
}

}  // namespace tether
