#include "fluid/ilu.hpp"

#include <cmath>

#include "common/base/error.hpp"

namespace tether {

void Ilu0::factor(const SparseMatrix& matrix) {
  factors_ = matrix;
  const int n = static_cast<int>(matrix.rows());
  const int* start = factors_.outerIndexPtr();
  const int* column = factors_.innerIndexPtr();
  double* value = factors_.valuePtr();
  diagonal_.assign(static_cast<std::size_t>(n), -1);
  std::vector<int> place(static_cast<std::size_t>(n), -1);  // of column j in the current row
  for (int row = 0; row < n; ++row) {
    for (int k = start[row]; k < start[row + 1]; ++k) place[static_cast<std::size_t>(column[k])] = k;
    for (int k = start[row]; k < start[row + 1] && column[k] < row; ++k) {
      const int pivot = column[k];
      value[k] *= value[diagonal_[static_cast<std::size_t>(pivot)]];
      for (int m = diagonal_[static_cast<std::size_t>(pivot)] + 1; m < start[pivot + 1]; ++m)
        if (const int target = place[static_cast<std::size_t>(column[m])]; target >= 0)
          value[target] -= value[k] * value[m];
    }
    const int d = place[static_cast<std::size_t>(row)];
    if (d < 0 || value[d] == 0.0 || !std::isfinite(value[d]))
      throw run_error("incomplete LU: zero pivot in row {}", row);
    value[d] = 1.0 / value[d];
    diagonal_[static_cast<std::size_t>(row)] = d;
    for (int k = start[row]; k < start[row + 1]; ++k) place[static_cast<std::size_t>(column[k])] = -1;
  }
}

void Ilu0::solve_in_place(Points& x) const {
  const int n = static_cast<int>(factors_.rows());
  const int* start = factors_.outerIndexPtr();
  const int* column = factors_.innerIndexPtr();
  const double* value = factors_.valuePtr();
  for (int row = 0; row < n; ++row) {
    Vec3 sum = x.col(row);
    for (int k = start[row]; k < diagonal_[static_cast<std::size_t>(row)]; ++k) sum -= value[k] * x.col(column[k]);
    x.col(row) = sum;
  }
  for (int row = n - 1; row >= 0; --row) {
    const int d = diagonal_[static_cast<std::size_t>(row)];
    Vec3 sum = x.col(row);
    for (int k = d + 1; k < start[row + 1]; ++k) sum -= value[k] * x.col(column[k]);
    x.col(row) = value[d] * sum;
  }
}

}  // namespace tether
