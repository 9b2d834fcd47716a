#include "common/linalg/cholesky.hpp"

#include <cholmod.h>
#include <omp.h>

#include "common/base/error.hpp"
#include "common/linalg/blas_kernels.hpp"

namespace tether {

struct Cholesky::Data {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  mutable cholmod_dense* work_y = nullptr;
  mutable cholmod_dense* work_e = nullptr;

  Data() {
    prepare_blas();
    omp_set_max_active_levels(
        0);  // CHOLMOD asks for four threads whatever the environment says; they spin, and cost 40 % CPU
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
    common.print = 0;
  }
  ~Data() {
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&work_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;
};

namespace {

/// A symmetric row-major matrix read as compressed columns; CHOLMOD then uses its upper half only.
cholmod_sparse view(const SparseMatrix& matrix) {
  cholmod_sparse result{};
  result.nrow = result.ncol = static_cast<std::size_t>(matrix.rows());
  result.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  result.p = const_cast<int*>(matrix.outerIndexPtr());
  result.i = const_cast<int*>(matrix.innerIndexPtr());
  result.x = const_cast<double*>(matrix.valuePtr());
  result.stype = 1;
  result.itype = CHOLMOD_INT;
  result.xtype = CHOLMOD_REAL;
  result.dtype = CHOLMOD_DOUBLE;
  result.sorted = 1;
  result.packed = 1;
  return result;
}

/// A fill-reducing order of all unknowns from one of the nodes: METIS on a graph 9 times smaller.
std::vector<int> order_by_nodes(const SparseMatrix& matrix, int components, cholmod_common& common) {
  const int nodes = static_cast<int>(matrix.rows()) / components;
  std::vector<int> start(static_cast<std::size_t>(nodes) + 1, 0), index;
  for (int node = 0; node < nodes; ++node) {
    for (SparseMatrix::InnerIterator entry(matrix, node * components); entry; ++entry)
      if (entry.col() % components == 0) index.push_back(static_cast<int>(entry.col()) / components);
    start[static_cast<std::size_t>(node) + 1] = static_cast<int>(index.size());
  }
  cholmod_sparse graph{};
  graph.nrow = graph.ncol = static_cast<std::size_t>(nodes);
  graph.nzmax = index.size();
  graph.p = start.data();
  graph.i = index.data();
  graph.stype = 1;
  graph.itype = CHOLMOD_INT;
  graph.xtype = CHOLMOD_PATTERN;
  graph.sorted = 1;
  graph.packed = 1;
  std::vector<int> node_order(static_cast<std::size_t>(nodes)), order;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  cholmod_factor* symbolic = cholmod_analyze(&graph, &common);
  if (symbolic == nullptr) throw run_error("the ordering of a sparse matrix failed (CHOLMOD status {})", common.status);
  const int* permutation = static_cast<const int*>(symbolic->Perm);
  std::copy_n(permutation, nodes, node_order.begin());
  cholmod_free_factor(&symbolic, &common);
  order.reserve(static_cast<std::size_t>(matrix.rows()));
  for (int node : node_order)
    for (int c = 0; c < components; ++c) order.push_back(node * components + c);
  return order;
}

}  // namespace

Cholesky::Cholesky() : data_(std::make_unique<Data>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::analyze(const SparseMatrix& matrix, int components) {
  auto& common = data_->common;
  auto order = order_by_nodes(matrix, components, common);
  cholmod_sparse a = view(matrix);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 1;
  cholmod_free_factor(&data_->factor, &common);
  data_->factor = cholmod_analyze_p(&a, order.data(), nullptr, 0, &common);
  if (data_->factor == nullptr)
    throw run_error("the analysis of a sparse matrix failed (CHOLMOD status {})", common.status);
}

void Cholesky::factor(const SparseMatrix& matrix) {
  if (!factor_if_definite(matrix)) throw run_error("a matrix that should be positive definite is not");
}

bool Cholesky::factor_if_definite(const SparseMatrix& matrix) {
  if (data_->factor == nullptr) analyze(matrix);
  cholmod_sparse a = view(matrix);
  cholmod_factorize(&a, data_->factor, &data_->common);
  if (data_->common.status < 0)
    throw run_error("a sparse factorisation failed (CHOLMOD status {})", data_->common.status);
  return data_->common.status != CHOLMOD_NOT_POSDEF;
}

void Cholesky::solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  cholmod_dense b{};
  b.nrow = static_cast<std::size_t>(rhs.rows());
  b.ncol = static_cast<std::size_t>(rhs.cols());
  b.d = static_cast<std::size_t>(rhs.outerStride());
  b.nzmax = b.d * b.ncol;
  b.x = rhs.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = nullptr;
  cholmod_solve2(CHOLMOD_A, data_->factor, &b, nullptr, &x, nullptr, &data_->work_y, &data_->work_e, &data_->common);
  if (x == nullptr) throw run_error("a sparse solve failed (CHOLMOD status {})", data_->common.status);
  rhs = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(
      static_cast<const double*>(x->x), rhs.rows(), rhs.cols(), Eigen::OuterStride<>(static_cast<Eigen::Index>(x->d)));
  cholmod_free_dense(&x, &data_->common);
}

VectorXd Cholesky::solve(const VectorXd& rhs) const {
  Eigen::MatrixXd x = rhs;
  solve_in_place(x);
  return x.col(0);
}

bool Cholesky::has_factor() const {
  return data_->factor != nullptr && data_->factor->xtype != CHOLMOD_PATTERN;
}

double Cholesky::factor_megabytes() const {
  return data_->factor == nullptr
             ? 0.0
             : 8e-6 * static_cast<double>(data_->factor->is_super ? data_->factor->xsize : data_->factor->nzmax);
}

}  // namespace tether
