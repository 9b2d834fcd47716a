/// GMRES on matrices whose spectra are known, alone and in sequences.
#include "fsi_master/recycled_gmres.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace tether {
namespace gmres_test {

MatrixXd random_matrix(int n) {
  std::srand(5);
  return MatrixXd::Random(n, n);
}

/// Not symmetric, not normal: S diag(values) S^-1.
MatrixXd with_eigenvalues(const VectorXd& values) {
  const MatrixXd S =
      random_matrix(static_cast<int>(values.size())) + 3 * MatrixXd::Identity(values.size(), values.size());
  return S * values.asDiagonal() * S.inverse();
}

KrylovResult solve(const MatrixXd& A, const VectorXd& b, VectorXd& x, double target, int most) {
  x = VectorXd::Zero(b.size());
  return gmres([&A](const VectorXd& v) -> VectorXd { return A * v; }, b, x, target, most);
}

TEST(Gmres, IsExactInAsManyStepsAsThereAreUnknowns) {
  const MatrixXd A = random_matrix(12);
  const VectorXd exact = VectorXd::LinSpaced(12, -1, 1);
  VectorXd x;
  const KrylovResult result = solve(A, A * exact, x, 1e-10, 12);
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.iterations, 12);
  EXPECT_LT((x - exact).norm(), 1e-7 * exact.norm());
}

TEST(Gmres, TakesOneStepForEachDistinctEigenvalue) {
  VectorXd values(30);
  for (int i = 0; i < 30; ++i) values[i] = std::array{1.0, -2.0, 5.0, 9.0}[static_cast<std::size_t>(i % 4)];
  const MatrixXd A = with_eigenvalues(values);
  const VectorXd b = VectorXd::Ones(30);
  VectorXd x;
  const KrylovResult result = solve(A, b, x, 1e-9 * b.norm(), 30);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 4);
  EXPECT_GT(solve(A, b, x, 1e-9 * b.norm(), 3).residual, 1e-6);
}

/// The residual that it reports, by its rotations, is that of its x, and no combination of as many powers leaves less.
TEST(Gmres, LeavesTheLeastResidualAndSaysHowMuch) {
  const MatrixXd A = random_matrix(40) + 8 * MatrixXd::Identity(40, 40);
  const VectorXd b = VectorXd::LinSpaced(40, 1, 3);
  MatrixXd powers(40, 0);
  VectorXd next = b;
  for (int k = 1; k <= 6; ++k) {
    next = (A * next).normalized();
    powers.conservativeResize(Eigen::NoChange, k);
    powers.col(k - 1) = next;  // A times the Krylov space
    const double least = (b - powers * powers.householderQr().solve(b)).norm();
    VectorXd x;
    const KrylovResult result = solve(A, b, x, 0, k);
    EXPECT_NEAR((b - A * x).norm(), least, 1e-9 * b.norm()) << k;
    EXPECT_NEAR(result.residual * b.norm(), least, 1e-9 * b.norm()) << k;
  }
}

TEST(Gmres, AddsToXAndStopsAtOnceBelowTheTarget) {
  const MatrixXd A = random_matrix(10) + 6 * MatrixXd::Identity(10, 10);
  const VectorXd exact = VectorXd::LinSpaced(10, 1, 2);
  const auto apply = [&A](const VectorXd& v) -> VectorXd { return A * v; };
  VectorXd x = 0.7 * exact;
  gmres(apply, A * (exact - x), x, 1e-12, 10);
  EXPECT_LT((x - exact).norm(), 1e-11);
  const VectorXd before = x;
  EXPECT_EQ(gmres(apply, VectorXd::Constant(10, 1e-3), x, 1, 10).iterations, 0);
  EXPECT_EQ(x, before);
}

TEST(Gmres, FindsTheSolutionInTheFirstStepIfItIsTheResidual) {
  const VectorXd b = VectorXd::LinSpaced(8, 1, 2);
  VectorXd x;
  const KrylovResult result = solve(2 * MatrixXd::Identity(8, 8), b, x, 1e-14, 8);  // nothing is left to go on with
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LT((x - b / 2).norm(), 1e-15);
}

TEST(Gmres, SaysWhenItDoesNotConverge) {
  MatrixXd shift = MatrixXd::Zero(10, 10);  // a cyclic shift: nothing is gained before the last step
  for (int i = 0; i < 10; ++i) shift((i + 1) % 10, i) = 1;
  VectorXd x;
  const KrylovResult result = solve(shift, VectorXd::Unit(10, 0), x, 1e-12, 9);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 9);
  EXPECT_NEAR(result.residual, 1, 1e-14);
  EXPECT_TRUE(solve(shift, VectorXd::Unit(10, 0), x, 1e-12, 10).converged);
}

/// A sequence of matrices with six outlying eigenvalues whose directions turn a little from one to the next.
struct Sequence {
  static constexpr int size = 50;
  MatrixXd fixed = random_matrix(size), turning = MatrixXd::Random(size, 6), basis = MatrixXd::Random(size, 6);
  MatrixXd at(int k) const {
    const MatrixXd Q = (basis + 0.01 * k * turning).householderQr().householderQ() * MatrixXd::Identity(size, 6);
    return MatrixXd::Identity(size, size) + 5e-3 * fixed +
           Q * VectorXd::LinSpaced(6, 30, 4).asDiagonal() * Q.transpose();
  }
  VectorXd right_hand_side(int k) const { return fixed.col(k) + VectorXd::Ones(size); }
};

TEST(RecycledGmres, EndsOnTheSameSolutionInFewerIterations) {
  const Sequence sequence;
  Recycling known;
  int alone = 0, recycled = 0;
  for (int k = 0; k < 10; ++k) {
    const MatrixXd A = sequence.at(k);
    const VectorXd b = sequence.right_hand_side(k);
    const double target = 1e-5 * b.norm();
    VectorXd x, y = VectorXd::Zero(b.size());
    const KrylovResult one = solve(A, b, x, target, 50);
    const KrylovResult other =
        recycled_gmres([&A](const VectorXd& v) -> VectorXd { return A * v; }, b, y, target, 50, known);
    EXPECT_TRUE(other.converged);
    EXPECT_LE((b - A * y).norm(), 1.001 * target) << k;
    EXPECT_NEAR((b - A * y).norm(), other.residual * b.norm(), 1e-3 * target) << "what it reports";
    EXPECT_LT((x - y).norm(), 2e-5 * b.norm());
    if (k == 0) {
      EXPECT_EQ(one.iterations, other.iterations) << "nothing is known yet";
      continue;
    }
    alone += one.iterations;
    recycled += other.iterations;
  }
  EXPECT_LE(3 * recycled, 2 * alone) << recycled << " instead of " << alone;
}

TEST(RecycledGmres, WithoutResidualDoesNothingAndForgetsNothing) {
  const Sequence sequence;
  Recycling known;
  VectorXd x = VectorXd::Zero(sequence.size);
  const auto apply = [&](const VectorXd& v) -> VectorXd { return sequence.at(0) * v; };
  recycled_gmres(apply, sequence.right_hand_side(0), x, 1e-3, 50, known);
  const int directions = known.directions();
  const VectorXd before = x;
  EXPECT_GT(directions, 0);
  EXPECT_EQ(recycled_gmres(apply, VectorXd::Zero(sequence.size), x, 1e-3, 50, known).iterations, 0);
  EXPECT_EQ(x, before);
  EXPECT_EQ(known.directions(), directions);
}

}  // namespace gmres_test
}  // namespace tether
