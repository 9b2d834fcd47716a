#include "common/linalg/cholesky.hpp"

#include <cholmod.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/linalg/rounded_factor.hpp"
#include "common/linalg/supernodal.hpp"

namespace tether {

struct Cholesky::Data {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  mutable cholmod_dense* work_y = nullptr;
  mutable cholmod_dense* work_e = nullptr;
  RoundedFactor rounded{common};
  mutable std::vector<float> solution;

  Data() { prepare_cholmod(common); }
  ~Data() {
    rounded.drop();
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&work_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Data(const Data&) = delete;
  Data& operator=(const Data&) = delete;

  void solve_rounded(Eigen::Ref<VectorXd> rhs) const;
};

void Cholesky::Data::solve_rounded(Eigen::Ref<VectorXd> rhs) const {
  const double scale = rhs.cwiseAbs().maxCoeff();  // single precision has a small range
  if (scale == 0) return;
  const int* order = static_cast<const int*>(factor->Perm);
  solution.resize(factor->n);
  for (std::size_t i = 0; i < factor->n; ++i) solution[i] = static_cast<float>(rhs[order[i]] / scale);
  rounded.solve_forward(solution.data());
  rounded.solve_backward(solution.data());
  for (std::size_t i = 0; i < factor->n; ++i) rhs[order[i]] = scale * static_cast<double>(solution[i]);
}

Cholesky::Cholesky() : data_(std::make_unique<Data>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::analyze(const SparseMatrix& matrix, int components) {
  auto& common = data_->common;
  auto order = order_by_nodes(matrix, components, common);
  cholmod_sparse a = view_of(matrix);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = 1;
  data_->rounded.drop();
  cholmod_free_factor(&data_->factor, &common);
  data_->factor = cholmod_analyze_p(&a, order.data(), nullptr, 0, &common);
  if (data_->factor == nullptr)
    throw run_error("the analysis of a sparse matrix failed (CHOLMOD status {})", common.status);
}

bool Cholesky::factor_if_definite(const SparseMatrix& matrix) {
  if (data_->factor == nullptr) analyze(matrix);
  data_->rounded.drop();
  cholmod_sparse a = view_of(matrix);
  cholmod_factorize(&a, data_->factor, &data_->common);
  if (data_->common.status < 0)
    throw run_error("a sparse factorisation failed (CHOLMOD status {})", data_->common.status);
  return data_->common.status != CHOLMOD_NOT_POSDEF;
}

bool Cholesky::factor_roughly(const SparseMatrix& matrix, double tolerance) {
  if (!factor_if_definite(matrix)) return false;
  if (!data_->factor->is_super) return true;
  data_->rounded.take(*data_->factor, static_cast<int>(data_->factor->n));
  return solves_within(tolerance, matrix) || factor_if_definite(matrix);
}

void Cholesky::solve_in_place(Eigen::Ref<Eigen::MatrixXd> rhs) const {
  if (!data_->rounded.is_empty()) {
    for (Eigen::Index column = 0; column < rhs.cols(); ++column) data_->solve_rounded(rhs.col(column));
    return;
  }
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

bool Cholesky::has_factor() const {
  return data_->factor != nullptr && (data_->factor->xtype != CHOLMOD_PATTERN || !data_->rounded.is_empty());
}

double Cholesky::factor_megabytes() const {
  if (data_->factor == nullptr) return 0;
  if (!data_->rounded.is_empty()) return data_->rounded.megabytes();
  return 8e-6 * static_cast<double>(data_->factor->is_super ? data_->factor->xsize : data_->factor->nzmax);
}

}  // namespace tether
