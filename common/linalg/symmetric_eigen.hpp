#pragma once

#include "common/base/types.hpp"

namespace tether {

/// A = vectors diag(values) vectors^T.
struct SymmetricEigen {
  VectorXd values;   ///< ascending
  MatrixXd vectors;  ///< orthonormal, one column each
};

/// Of a symmetric matrix, whose upper triangle is not read. By LAPACK, which divides and conquers (Cuppen 1981):
/// several times as fast as Eigen's QL steps from a few hundred rows on. Throws RunError where it does not converge, as
/// for entries that are not finite.
SymmetricEigen symmetric_eigen(MatrixXd matrix);

}  // namespace tether
