#include "common/linalg/symmetric_eigen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/error.hpp"

namespace tether {
namespace symmetric_eigen_test {

/// Of a chain of equal springs with fixed ends: 4 sin^2(k pi / (2 (n + 1))).
TEST(SymmetricEigen, OfAChainIsKnown) {
  constexpr Eigen::Index n = 300;
  MatrixXd chain = 2 * MatrixXd::Identity(n, n);
  chain.diagonal(-1).setConstant(-1);
  const SymmetricEigen found = symmetric_eigen(chain);
  for (Eigen::Index k = 0; k < n; ++k)
    EXPECT_NEAR(found.values(k), 4 * std::pow(std::sin((k + 1) * std::numbers::pi / (2 * (n + 1))), 2), 1e-13);
  chain.diagonal(1).setConstant(-1);
  EXPECT_LT((chain * found.vectors - found.vectors * found.values.asDiagonal()).norm(), 1e-12);
  EXPECT_LT((found.vectors.transpose() * found.vectors - MatrixXd::Identity(n, n)).norm(), 1e-12);
}

TEST(SymmetricEigen, OfNothingAndOfOneAreThere) {
  EXPECT_EQ(symmetric_eigen(MatrixXd(0, 0)).values.size(), 0);
  const SymmetricEigen one = symmetric_eigen(MatrixXd::Constant(1, 1, -3));
  EXPECT_EQ(one.values(0), -3);
  EXPECT_EQ(std::abs(one.vectors(0, 0)), 1);
}

TEST(SymmetricEigen, OfWhatIsNotFiniteIsAnError) {
  EXPECT_THROW(symmetric_eigen(MatrixXd::Constant(3, 3, std::numeric_limits<double>::quiet_NaN())), RunError);
}

}  // namespace symmetric_eigen_test
}  // namespace tether
