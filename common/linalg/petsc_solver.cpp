// Built into a library of its own (shared_solver.hpp), with PETSc.
#include <petscksp.h>

#include <algorithm>
#include <vector>

#include "common/base/error.hpp"
#include "common/linalg/shared_solver.hpp"

namespace tether {
namespace {

/// Of the residual, in the norm of the preconditioner: mass is balanced to as much.
constexpr double tolerance = 1e-11;
constexpr int most_cycles = 200;
/// A hierarchy that takes so many times the cycles of a fresh one is made anew: the mesh has moved.
constexpr double worn = 1.5;

void check(PetscErrorCode code, const char* what) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw run_error("{} of PETSc fails: {}", what, text != nullptr ? text : "for no reason that it tells");
}

/// Starts PETSc on the processes of a team, once. It lives as long as the process: MPI_Finalize takes it along.
void start_petsc(const Team& team) {
  PetscBool started = PETSC_FALSE;
  PetscInitialized(&started);
  if (started == PETSC_TRUE) return;
  PETSC_COMM_WORLD = MPI_Comm_f2c(team.communicator());
  // Signals and messages are the programs' own; a file in the working directory is nobody's to be read.
  static char program[] = "tether", signals[] = "-no_signal_handler", file[] = "-skip_petscrc";
  static char* words[] = {program, signals, file, nullptr};
  int count = 3;
  char** all = words;
  check(PetscInitialize(&count, &all, nullptr, nullptr), "PetscInitialize");
  check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr), "PetscPushErrorHandler");
}

/// Of an own row: where it refers to in PETSc's numbering, and where its value stands in the matrix.
struct Entry {
  int column, from;
};

/// Conjugate gradients with hypre's algebraic multigrid. (docs/decisions/0125-several-processes.md)
class Multigrid final : public SymmetricSolver {
 public:
  explicit Multigrid(const Share& share) : share_(share) { start_petsc(share.team()); }
  ~Multigrid() override { drop(); }

  void analyze(const SparseMatrix& matrix, int components) override;
  bool factor_if_definite(const SparseMatrix& matrix) override;
  bool factor_roughly(const SparseMatrix& matrix, double /*tolerance*/) override { return factor_if_definite(matrix); }
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const override;
  void forget() override { cycles_ = first_cycles_ = 0; }
  bool has_factor() const override { return has_values_; }
  double factor_megabytes() const override { return 0; }

 private:
  void drop() {
    KSPDestroy(&solver_);
    VecDestroy(&vector_);
    MatDestroy(&matrix_);
  }
  void make_solver();
  void solve() const;

  const Share& share_;
  std::vector<int> from_;       ///< in the matrix's values: those of the own rows, in PETSc's order
  std::vector<double> values_;  ///< of the own rows
  Mat matrix_ = nullptr;
  KSP solver_ = nullptr;
  Vec vector_ = nullptr;
  bool has_values_ = false;
  mutable int cycles_ = 0, first_cycles_ = 0;  ///< of the latest solve, and of the first with the hierarchy
};

void Multigrid::analyze(const SparseMatrix& matrix, int components) {
  TETHER_ASSERT(components == 1 && matrix.rows() == share_.nodes(), "{} rows of {} nodes", matrix.rows(),
                share_.nodes());
  drop();
  has_values_ = false;
  std::vector<int> place(static_cast<std::size_t>(share_.nodes()));  // of a node in PETSc's order
  for (std::size_t i = 0; i < place.size(); ++i)
    place[static_cast<std::size_t>(share_.by_owner()[i])] = static_cast<int>(i);

  from_.clear();
  std::vector<PetscInt> starts{0}, columns;
  std::vector<Entry> row;
  for (const int node : share_.own()) {
    row.clear();
    int from = matrix.outerIndexPtr()[node];
    for (SparseMatrix::InnerIterator entry(matrix, node); entry; ++entry, ++from)
      row.push_back({place[static_cast<std::size_t>(entry.col())], from});
    std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
    for (const Entry& entry : row) {
      columns.push_back(entry.column);
      from_.push_back(entry.from);
    }
    starts.push_back(static_cast<PetscInt>(columns.size()));
  }
  values_.assign(columns.size(), 0.0);

  const auto own = static_cast<PetscInt>(share_.own().size()), all = static_cast<PetscInt>(share_.nodes());
  check(MatCreateMPIAIJWithArrays(PETSC_COMM_WORLD, own, own, all, all, starts.data(), columns.data(), values_.data(),
                                  &matrix_),
        "MatCreateMPIAIJWithArrays");
  check(VecCreateMPI(PETSC_COMM_WORLD, own, all, &vector_), "VecCreateMPI");
  make_solver();
}

void Multigrid::make_solver() {
  PC cycles = nullptr;
  check(KSPCreate(PETSC_COMM_WORLD, &solver_), "KSPCreate");
  check(KSPSetOperators(solver_, matrix_, matrix_), "KSPSetOperators");
  check(KSPSetType(solver_, KSPCG), "KSPSetType");
  check(KSPSetTolerances(solver_, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_cycles), "KSPSetTolerances");
  check(KSPGetPC(solver_, &cycles), "KSPGetPC");
  check(PCSetType(cycles, PCHYPRE), "PCSetType");
  check(PCHYPRESetType(cycles, "boomeramg"), "PCHYPRESetType");
  // For Laplacians in three dimensions, as hypre's manual has it.
  for (const auto& [name, value] :
       {std::pair{"-pc_hypre_boomeramg_strong_threshold", "0.5"}, std::pair{"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
        std::pair{"-pc_hypre_boomeramg_interp_type", "ext+i"}, std::pair{"-pc_hypre_boomeramg_P_max", "4"},
        std::pair{"-pc_hypre_boomeramg_agg_nl", "1"}})
    check(PetscOptionsSetValue(nullptr, name, value), "PetscOptionsSetValue");
  check(PCSetFromOptions(cycles), "PCSetFromOptions");
}

bool Multigrid::factor_if_definite(const SparseMatrix& matrix) {
  if (matrix_ == nullptr) analyze(matrix, 1);
  for (std::size_t k = 0; k < from_.size(); ++k) values_[k] = matrix.valuePtr()[from_[k]];
  check(MatUpdateMPIAIJWithArray(matrix_, values_.data()), "MatUpdateMPIAIJWithArray");
  check(KSPSetOperators(solver_, matrix_, matrix_), "KSPSetOperators");
  const bool is_fresh = first_cycles_ == 0 || cycles_ > worn * first_cycles_;
  check(KSPSetReusePreconditioner(solver_, is_fresh ? PETSC_FALSE : PETSC_TRUE), "KSPSetReusePreconditioner");
  check(KSPSetUp(solver_), "KSPSetUp");
  if (is_fresh) cycles_ = first_cycles_ = 0;
  return has_values_ = true;
}

void Multigrid::solve() const {
  check(KSPSolve(solver_, vector_, vector_), "KSPSolve");
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt cycles = 0;
  check(KSPGetConvergedReason(solver_, &reason), "KSPGetConvergedReason");
  check(KSPGetIterationNumber(solver_, &cycles), "KSPGetIterationNumber");
  if (reason < 0)
    throw run_error("conjugate gradients with multigrid stop after {} cycles (PETSc: {})", cycles,
                    static_cast<int>(reason));
  cycles_ = static_cast<int>(cycles);
  if (first_cycles_ == 0) first_cycles_ = cycles_;
}

void Multigrid::solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  const std::span<const int> own = share_.own();
  VectorXd column;
  for (Eigen::Index k = 0; k < rhs.cols(); ++k) {
    column = rhs.col(k);
    double* part = nullptr;
    check(VecGetArray(vector_, &part), "VecGetArray");
    for (std::size_t i = 0; i < own.size(); ++i) part[i] = column[own[i]];
    check(VecRestoreArray(vector_, &part), "VecRestoreArray");
    solve();
    check(VecGetArray(vector_, &part), "VecGetArray");
    for (std::size_t i = 0; i < own.size(); ++i) column[own[i]] = part[i];
    check(VecRestoreArray(vector_, &part), "VecRestoreArray");
    share_.complete({column.data(), static_cast<std::size_t>(column.size())}, 1);
    rhs.col(k) = column;
  }
}

}  // namespace
}  // namespace tether

extern "C" tether::SymmetricSolver* tether_make_shared_solver(const tether::Share& share) {
  return new tether::Multigrid(share);
}
