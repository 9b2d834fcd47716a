// Built into a library of its own (shared_solver.hpp), with PETSc.
#include <petscksp.h>

#include <algorithm>
#include <vector>

#include "common/base/error.hpp"
#include "common/linalg/shared_solver.hpp"

namespace tether {
namespace {

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

/// Unknowns above which cycles of multigrid take less than a factor and its solves, and far less memory: a factor of a
/// mesh in three dimensions grows as the square of the nodes, in work. (docs/decisions/0125-several-processes.md)
constexpr int most_factored = 150'000;
/// Of the residual, in the norm of the preconditioner: mass is balanced to as much.
constexpr double multigrid_tolerance = 1e-11;
constexpr int most_cycles = 200;
/// A preconditioner that takes so many times the cycles of a fresh one is made anew: the mesh has moved.
constexpr double worn = 1.5;

/// Factors by MUMPS, whose rows are shared by the processes; of one unknown a node, where there are many, conjugate
/// gradients with hypre's algebraic multigrid. (docs/decisions/0125-several-processes.md)
class PetscSolver final : public SymmetricSolver {
 public:
  explicit PetscSolver(const Share& share) : share_(share) { start_petsc(share.team()); }
  ~PetscSolver() override { drop(); }

  void analyze(const SparseMatrix& matrix, int components) override;
  bool factor_if_definite(const SparseMatrix& matrix) override;
  bool factor_roughly(const SparseMatrix& matrix, double /*tolerance*/) override { return factor_if_definite(matrix); }
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const override;
  bool has_factor() const override { return has_factor_; }
  double factor_megabytes() const override;

 private:
  void drop() {
    KSPDestroy(&solver_);
    VecDestroy(&vector_);
    MatDestroy(&matrix_);
  }
  void choose_method();
  void choose_factors();
  void solve() const;
  void choose_multigrid();
  bool factor_anew();
  void make_multigrid_anew_if_worn();
  bool is_multigrid() const { return components_ == 1 && share_.nodes() > most_factored; }
  Mat factor_matrix() const {
    PC factors = nullptr;
    Mat result = nullptr;
    check(KSPGetPC(solver_, &factors), "KSPGetPC");
    check(PCFactorGetMatrix(factors, &result), "PCFactorGetMatrix");
    return result;
  }
  PetscInt information(PetscInt number) const {
    PetscInt value = 0;
    check(MatMumpsGetInfog(factor_matrix(), number, &value), "MatMumpsGetInfog");
    return value;
  }

  const Share& share_;
  int components_ = 1;
  std::vector<int> from_;       ///< in the matrix's values: those of the own rows, in PETSc's order
  std::vector<double> values_;  ///< of the own rows
  Mat matrix_ = nullptr;
  KSP solver_ = nullptr;
  Vec vector_ = nullptr;
  bool has_factor_ = false;
  mutable int cycles_ = 0, first_cycles_ = 0;  ///< of the latest solve, and of the first with the preconditioner
};

void PetscSolver::analyze(const SparseMatrix& matrix, int components) {
  TETHER_ASSERT(matrix.rows() == Eigen::Index{share_.nodes()} * components, "{} rows of {} nodes", matrix.rows(),
                share_.nodes());
  drop();
  has_factor_ = false;
  components_ = components;
  std::vector<int> place(static_cast<std::size_t>(share_.nodes()));  // of a node in PETSc's order
  for (std::size_t i = 0; i < place.size(); ++i)
    place[static_cast<std::size_t>(share_.by_owner()[i])] = static_cast<int>(i);

  from_.clear();
  std::vector<PetscInt> starts{0}, columns;
  std::vector<Entry> row;
  for (const int node : share_.own())
    for (int component = 0; component < components; ++component) {
      row.clear();
      int from = matrix.outerIndexPtr()[node * components + component];
      for (SparseMatrix::InnerIterator entry(matrix, node * components + component); entry; ++entry, ++from) {
        const int column = static_cast<int>(entry.col());
        row.push_back({place[static_cast<std::size_t>(column / components)] * components + column % components, from});
      }
      std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
      for (const Entry& entry : row) {
        columns.push_back(entry.column);
        from_.push_back(entry.from);
      }
      starts.push_back(static_cast<PetscInt>(columns.size()));
    }
  values_.assign(columns.size(), 0.0);

  const auto own = static_cast<PetscInt>(share_.own().size()) * components,
             all = static_cast<PetscInt>(share_.nodes()) * components;
  const MPI_Comm team = PETSC_COMM_WORLD;
  check(MatCreateMPIAIJWithArrays(team, own, own, all, all, starts.data(), columns.data(), values_.data(), &matrix_),
        "MatCreateMPIAIJWithArrays");
  check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
  check(VecCreateMPI(team, own, all, &vector_), "VecCreateMPI");
  choose_method();
}

void PetscSolver::choose_method() {
  check(KSPCreate(PETSC_COMM_WORLD, &solver_), "KSPCreate");
  check(KSPSetOperators(solver_, matrix_, matrix_), "KSPSetOperators");
  if (is_multigrid())
    choose_multigrid();
  else
    choose_factors();
}

void PetscSolver::choose_multigrid() {
  PC cycles = nullptr;
  check(KSPSetType(solver_, KSPCG), "KSPSetType");
  check(KSPSetTolerances(solver_, multigrid_tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most_cycles), "KSPSetTolerances");
  check(KSPGetPC(solver_, &cycles), "KSPGetPC");
  check(PCSetType(cycles, PCHYPRE), "PCSetType");
  check(PCHYPRESetType(cycles, "boomeramg"), "PCHYPRESetType");
  // What hypre's manual advises for Laplacians in three dimensions.
  for (const auto& [name, value] :
       {std::pair{"-pc_hypre_boomeramg_strong_threshold", "0.5"}, std::pair{"-pc_hypre_boomeramg_coarsen_type", "HMIS"},
        std::pair{"-pc_hypre_boomeramg_interp_type", "ext+i"}, std::pair{"-pc_hypre_boomeramg_P_max", "4"},
        std::pair{"-pc_hypre_boomeramg_agg_nl", "1"}})
    check(PetscOptionsSetValue(nullptr, name, value), "PetscOptionsSetValue");
  check(PCSetFromOptions(cycles), "PCSetFromOptions");
}

void PetscSolver::choose_factors() {
  constexpr PetscInt spare_room = 14, spare_percent = 60;
  PC factors = nullptr;
  check(KSPSetType(solver_, KSPPREONLY), "KSPSetType");
  check(KSPGetPC(solver_, &factors), "KSPGetPC");
  check(PCSetType(factors, PCCHOLESKY), "PCSetType");
  check(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS), "PCFactorSetMatSolverType");
  check(PCFactorSetUpMatSolverType(factors), "PCFactorSetUpMatSolverType");
  check(MatMumpsSetIcntl(factor_matrix(), spare_room, spare_percent), "MatMumpsSetIcntl");
}

bool PetscSolver::factor_if_definite(const SparseMatrix& matrix) {
  if (matrix_ == nullptr) analyze(matrix, 1);
  for (std::size_t k = 0; k < from_.size(); ++k) values_[k] = matrix.valuePtr()[from_[k]];
  check(MatUpdateMPIAIJWithArray(matrix_, values_.data()), "MatUpdateMPIAIJWithArray");
  check(KSPSetOperators(solver_, matrix_, matrix_), "KSPSetOperators");
  if (!is_multigrid()) return has_factor_ = factor_anew();
  make_multigrid_anew_if_worn();
  return has_factor_ = true;
}

void PetscSolver::make_multigrid_anew_if_worn() {
  const bool is_fresh = first_cycles_ == 0 || cycles_ > worn * first_cycles_;
  check(KSPSetReusePreconditioner(solver_, is_fresh ? PETSC_FALSE : PETSC_TRUE), "KSPSetReusePreconditioner");
  check(KSPSetUp(solver_), "KSPSetUp");
  if (is_fresh) cycles_ = first_cycles_ = 0;
}

bool PetscSolver::factor_anew() {
  constexpr PetscInt negative_pivots = 12;
  check(KSPSetUp(solver_), "KSPSetUp");
  PC factors = nullptr;
  PCFailedReason failed = PC_NOERROR;
  check(KSPGetPC(solver_, &factors), "KSPGetPC");
  check(PCGetFailedReason(factors, &failed), "PCGetFailedReason");
  if (failed == PC_FACTOR_OUTMEMORY) throw run_error("a sparse factorisation gets no more memory (MUMPS)");
  return failed == PC_NOERROR && information(negative_pivots) == 0;
}

void PetscSolver::solve() const {
  check(KSPSolve(solver_, vector_, vector_), "KSPSolve");
  if (!is_multigrid()) return;
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

void PetscSolver::solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  const std::span<const int> own = share_.own();
  VectorXd column;
  for (Eigen::Index k = 0; k < rhs.cols(); ++k) {
    column = rhs.col(k);
    double* part = nullptr;
    const auto for_own = [&](const auto& visit) {
      for (std::size_t i = 0; i < own.size(); ++i)
        for (int c = 0; c < components_; ++c)
          visit(part[i * static_cast<std::size_t>(components_) + static_cast<std::size_t>(c)],
                column[own[i] * components_ + c]);
    };
    check(VecGetArray(vector_, &part), "VecGetArray");
    for_own([](double& here, double there) { here = there; });
    check(VecRestoreArray(vector_, &part), "VecRestoreArray");
    solve();
    check(VecGetArray(vector_, &part), "VecGetArray");
    for_own([](double here, double& there) { there = here; });
    check(VecRestoreArray(vector_, &part), "VecRestoreArray");
    share_.complete({column.data(), static_cast<std::size_t>(column.size())}, components_);
    rhs.col(k) = column;
  }
}

double PetscSolver::factor_megabytes() const {
  constexpr PetscInt megabytes_here = 22;  // of all processes: INFOG(22)
  return has_factor_ && !is_multigrid() ? static_cast<double>(information(megabytes_here)) / share_.team().size() : 0.0;
}

}  // namespace
}  // namespace tether

extern "C" tether::SymmetricSolver* tether_make_shared_solver(const tether::Share& share) {
  return new tether::PetscSolver(share);
}
