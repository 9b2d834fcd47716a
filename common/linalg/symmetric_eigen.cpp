#include "common/linalg/symmetric_eigen.hpp"

#include <vector>

#include "common/base/error.hpp"
#include "common/linalg/blas_kernels.hpp"

extern "C" {
void dsyevd_(const char* job, const char* triangle, const int* n, double* a, const int* lda, double* w, double* work,
             const int* lwork, int* iwork, const int* liwork, int* info);
}

namespace tether {

SymmetricEigen symmetric_eigen(MatrixXd matrix) {
  TETHER_ASSERT(matrix.rows() == matrix.cols(), "{} x {} is no square", matrix.rows(), matrix.cols());
  if (!matrix.allFinite())
    throw run_error("a symmetric matrix of {} rows has entries that are not finite", matrix.rows());
  prepare_blas();
  const int n = static_cast<int>(matrix.rows()), rows = std::max(n, 1), ask = -1;
  VectorXd values(n);
  double work_size = 0;
  int integer_size = 0, info = 0;
  dsyevd_("V", "L", &n, matrix.data(), &rows, values.data(), &work_size, &ask, &integer_size, &ask, &info);
  std::vector<double> work(static_cast<std::size_t>(work_size));
  std::vector<int> integers(static_cast<std::size_t>(integer_size));
  const int size = static_cast<int>(work.size());
  dsyevd_("V", "L", &n, matrix.data(), &rows, values.data(), work.data(), &size, integers.data(), &integer_size, &info);
  if (info != 0) throw run_error("the eigenvalues of a symmetric matrix of {} rows did not converge", n);
  return {std::move(values), std::move(matrix)};
}

}  // namespace tether
