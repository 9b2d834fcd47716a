/// Conjugate gradients on matrices whose eigenvalues are known.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>

#include "common/linalg/krylov.hpp"

namespace tether {
namespace conjugate_gradients_test {

const auto identity = [](const VectorXd& r) { return r; };

/// A symmetric matrix with these eigenvalues, its eigenvectors those of a random one.
MatrixXd with_eigenvalues(const VectorXd& values) {
  std::srand(3);
  const MatrixXd Q = MatrixXd::Random(values.size(), values.size()).householderQr().householderQ();
  return Q * values.asDiagonal() * Q.transpose();
}

KrylovResult solve(const MatrixXd& A, const VectorXd& b, VectorXd& x, double tolerance, int most) {
  x = VectorXd::Zero(b.size());
  return conjugate_gradients([&A](const VectorXd& v) -> VectorXd { return A * v; }, identity, b, x, tolerance, most);
}

TEST(ConjugateGradients, TakeOneStepForEachDistinctEigenvalue) {
  VectorXd values(30);
  for (int i = 0; i < 30; ++i) values[i] = std::array{1.0, 3.0, 10.0}[static_cast<std::size_t>(i % 3)];
  const MatrixXd A = with_eigenvalues(values);
  const VectorXd exact = VectorXd::LinSpaced(30, -1, 2);
  VectorXd x;
  const KrylovResult result = solve(A, A * exact, x, 1e-12, 30);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_LT((x - exact).norm(), 1e-11 * exact.norm());
  EXPECT_GT(solve(A, A * exact, x, 1e-12, 2).residual, 1e-6) << "two are not enough";
}

/// |e_k|_A <= 2 ((sqrt(c) - 1)/(sqrt(c) + 1))^k |e_0|_A, c the condition number.
TEST(ConjugateGradients, ConvergeAsFastAsTheirBound) {
  const double condition = 100, rate = (std::sqrt(condition) - 1) / (std::sqrt(condition) + 1);
  const MatrixXd A = with_eigenvalues(VectorXd::LinSpaced(80, 1, condition));
  const VectorXd exact = VectorXd::Ones(80);
  const auto error = [&](const VectorXd& x) { return std::sqrt((x - exact).dot(A * (x - exact))); };
  for (const int k : {1, 5, 10, 20, 40}) {
    VectorXd x;
    const KrylovResult result = solve(A, A * exact, x, 0, k);
    EXPECT_EQ(result.iterations, k);
    EXPECT_LE(error(x), 2 * std::pow(rate, k) * error(VectorXd::Zero(80))) << k;
  }
}

TEST(ConjugateGradients, WithTheInverseAsPreconditionerTakeOneStep) {
  const MatrixXd A = with_eigenvalues(VectorXd::LinSpaced(20, 1, 1e4));
  const VectorXd b = VectorXd::LinSpaced(20, 1, 2);
  const Eigen::LLT<MatrixXd> inverse(A);
  VectorXd x = VectorXd::Zero(20);
  const KrylovResult result =
      conjugate_gradients([&](const VectorXd& v) -> VectorXd { return A * v; },
                          [&](const VectorXd& r) -> VectorXd { return inverse.solve(r); }, b, x, 1e-8, 20);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LT((A * x - b).norm(), 1e-9 * b.norm());
}

TEST(ConjugateGradients, StartFromWhatIsGivenAndStopAtOnceWithoutResidual) {
  const MatrixXd A = with_eigenvalues(VectorXd::LinSpaced(20, 1, 50));
  const VectorXd exact = VectorXd::LinSpaced(20, 1, 2);
  VectorXd x = 0.5 * exact;  // the residual is that of x
  const auto apply = [&](const VectorXd& v) -> VectorXd { return A * v; };
  EXPECT_TRUE(conjugate_gradients(apply, identity, A * (exact - x), x, 1e-12, 40).converged);
  EXPECT_LT((x - exact).norm(), 1e-11 * exact.norm());
  const VectorXd before = x;
  const KrylovResult nothing = conjugate_gradients(apply, identity, VectorXd::Zero(20), x, 1e-12, 40);
  EXPECT_TRUE(nothing.converged);
  EXPECT_EQ(nothing.iterations, 0);
  EXPECT_EQ(x, before);
}

TEST(ConjugateGradients, SayWhenTheyDoNotConverge) {
  const MatrixXd A = with_eigenvalues(VectorXd::LinSpaced(60, 1, 1e6));
  VectorXd x;
  const KrylovResult result = solve(A, VectorXd::Ones(60), x, 1e-12, 5);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 5);
  EXPECT_GT(result.residual, 1e-12);
}

}  // namespace conjugate_gradients_test
}  // namespace tether
