/// Incomplete LU factors: exact where elimination fills nothing in, and on the pattern elsewhere.
#include "fluid/ilu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "common/base/error.hpp"

namespace tether {
namespace ilu_test {

SparseMatrix sparse(int n, const std::vector<Eigen::Triplet<double>>& entries) {
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix tridiagonal(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.5 + 0.1 * i);
    if (i > 0) entries.emplace_back(i, i - 1, -1.9);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -0.4);
  }
  return sparse(n, entries);
}

/// Five points a row on a square of m by m: elimination fills in.
SparseMatrix laplacian(int m) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < m * m; ++row) {
    entries.emplace_back(row, row, 4);
    if (row % m > 0) entries.emplace_back(row, row - 1, -1);
    if (row % m < m - 1) entries.emplace_back(row, row + 1, -1);
    if (row >= m) entries.emplace_back(row, row - m, -1);
    if (row < m * m - m) entries.emplace_back(row, row + m, -1);
  }
  return sparse(m * m, entries);
}

/// (L U)^-1, column by column.
MatrixXd inverse_of(const Ilu0& factors, int n) {
  MatrixXd inverse(n, n);
  for (int j = 0; j < n; ++j) {
    Points x = Points::Zero(3, n);
    x.col(j).setOnes();
    factors.solve_in_place(x);
    inverse.col(j) = x.row(0).transpose();
  }
  return inverse;
}

TEST(Ilu0, OfATridiagonalMatrixIsExactForThreeRightHandSides) {
  const int n = 40;
  const SparseMatrix matrix = tridiagonal(n);
  Ilu0 factors;
  factors.factor(matrix);
  Points exact(3, n);
  for (int i = 0; i < n; ++i) exact.col(i) = Vec3(std::sin(i), std::cos(2 * i), 1 + 0.1 * i);
  Points x = (matrix * exact.transpose()).transpose();
  factors.solve_in_place(x);
  EXPECT_LT((x - exact).norm(), 1e-13 * exact.norm());
}

/// What defines it: L U agrees with the matrix wherever that has an entry; what is left stands where it has none.
TEST(Ilu0, AgreesWithTheMatrixOnItsPattern) {
  const int m = 7, n = m * m;
  const SparseMatrix matrix = laplacian(m);
  Ilu0 factors;
  factors.factor(matrix);
  const MatrixXd product = inverse_of(factors, n).inverse(), dense = matrix;
  double elsewhere = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const bool in_pattern = dense(i, j) != 0;
      EXPECT_NEAR(product(i, j), in_pattern ? dense(i, j) : product(i, j), 1e-12) << i << " " << j;
      if (!in_pattern) elsewhere = std::max(elsewhere, std::abs(product(i, j)));
    }
  EXPECT_GT(elsewhere, 0.1) << "elimination would have filled in";
}

/// Of an M-matrix, L U is a regular splitting (Meijerink and van der Vorst 1977): the iteration x += (L U)^-1 (b - A x)
/// converges.
TEST(Ilu0, SplitsALaplacianRegularly) {
  const int m = 10, n = m * m;
  const MatrixXd dense = laplacian(m);
  Ilu0 factors;
  factors.factor(laplacian(m));
  const MatrixXd inverse = inverse_of(factors, n);
  EXPECT_GE(inverse.minCoeff(), 0);
  const MatrixXd left = MatrixXd::Identity(n, n) - inverse * dense;
  const double radius = left.eigenvalues().cwiseAbs().maxCoeff();
  EXPECT_LT(radius, 1);
  const MatrixXd jacobi = MatrixXd::Identity(n, n) - dense / 4;
  EXPECT_LT(radius, jacobi.eigenvalues().cwiseAbs().maxCoeff()) << "better than the diagonal alone";
}

TEST(Ilu0, IsMadeAnewForAnotherMatrix) {
  Ilu0 factors;
  factors.factor(laplacian(5));
  factors.factor(tridiagonal(6));
  Points x = (tridiagonal(6) * MatrixXd::Ones(6, 3)).transpose();
  factors.solve_in_place(x);
  EXPECT_LT((x - Points::Ones(3, 6)).norm(), 1e-14);
}

TEST(Ilu0, RefusesAZeroPivot) {
  Ilu0 factors;
  EXPECT_THROW(factors.factor(sparse(2, {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, 1, 1}})), RunError);  // 1 - 1
  EXPECT_THROW(factors.factor(sparse(2, {{0, 0, 1}, {1, 0, 1}})), RunError) << "no diagonal entry";
}

}  // namespace ilu_test
}  // namespace tether
