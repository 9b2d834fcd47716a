/// What solves leave for the next ones, on matrices whose outlying directions are known.
#include "common/linalg/recycling.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <cstdlib>

namespace tether {
namespace recycling_test {

constexpr int size = 60, outlying = 5;

MatrixXd random_matrix(int rows, int columns) {
  return MatrixXd::Random(rows, columns);
}

/// 1 + Q D Q' + noise: `outlying` directions of 20, 10, 6.7 ..., that turn with t, and little ones everywhere.
MatrixXd near_one(double t, double noise = 0.002) {
  std::srand(7);
  const MatrixXd first = random_matrix(size, outlying), second = random_matrix(size, outlying),
                 rest = noise * random_matrix(size, size);
  const MatrixXd turned = first + t * second;
  const MatrixXd Q = MatrixXd(turned.householderQr().householderQ()).leftCols(outlying);
  const VectorXd strengths = VectorXd::LinSpaced(outlying, 1, outlying).cwiseInverse() * 20;
  return MatrixXd::Identity(size, size) + rest + Q * strengths.asDiagonal() * Q.transpose();
}

/// Notes H x for the given x, as a solver would.
void teach(Recycling& recycling, const MatrixXd& H, const MatrixXd& X) {
  for (Eigen::Index j = 0; j < X.cols(); ++j) recycling.note(X.col(j), H * X.col(j));
  recycling.learn();
}

TEST(Recycling, KnowsNothingAtFirst) {
  Recycling recycling;
  const VectorXd v = VectorXd::LinSpaced(9, 1, 2);
  recycling.begin(v);
  EXPECT_EQ(recycling.solved(v), v);
  recycling.learn();
  EXPECT_EQ(recycling.directions(), 0);
}

TEST(Recycling, SolvesWhatItHasSeen) {
  const MatrixXd H = near_one(0, 0.05), X = random_matrix(size, 8);
  Recycling recycling;
  teach(recycling, H, X);
  EXPECT_EQ(recycling.directions(), 8);  // none is of so little use that it is dropped
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    EXPECT_LT((recycling.solved(H * X.col(j)) - X.col(j)).norm(), 1e-5 * X.col(j).norm());  // single precision
}

TEST(Recycling, LeavesOneWhereTheOutlyingDirectionsWereSeen) {
  const MatrixXd H = near_one(0);
  Recycling recycling;
  teach(recycling, H, H * (H * random_matrix(size, 12)));  // as the powers of a Krylov space
  MatrixXd inverse(size, size);
  for (int j = 0; j < size; ++j) inverse.col(j) = recycling.solved(VectorXd::Unit(size, j));
  const MatrixXd rest = H * inverse - MatrixXd::Identity(size, size);
  EXPECT_LT(rest.norm(), 0.2 * (H - MatrixXd::Identity(size, size)).norm());
}

TEST(Recycling, DropsDirectionsThatAreOfNoUse) {
  std::srand(7);
  const MatrixXd Q = MatrixXd(random_matrix(size, 4).householderQr().householderQ()).leftCols(4);
  const MatrixXd H = MatrixXd::Identity(size, size) + Q * VectorXd::LinSpaced(4, 9, 3).asDiagonal() *
                                                          Q.transpose();  // 56 directions are left as they are
  Recycling recycling;
  teach(recycling, H, random_matrix(size, 10));
  EXPECT_EQ(recycling.directions(), 4);
}

TEST(Recycling, KeepsTheMostOutlyingOfMany) {
  const VectorXd strengths = VectorXd::LinSpaced(size, 60, 1);
  const MatrixXd H = MatrixXd(strengths.asDiagonal());
  Recycling recycling;
  teach(recycling, H, MatrixXd::Identity(size, 30));
  EXPECT_EQ(recycling.directions(), 12);
  for (int i : {0, 11}) EXPECT_NEAR(recycling.solved(VectorXd::Unit(size, i))[i], 1 / strengths[i], 1e-6);
  EXPECT_EQ(recycling.solved(VectorXd::Unit(size, 12))[12], 1);
}

TEST(Recycling, FiltersColumnsThatDependOnOthers) {
  const MatrixXd H = near_one(0);
  MatrixXd X = random_matrix(size, 6);
  X.col(3) = X.col(1) + 1e-9 * X.col(3);
  X.col(4) = 2 * X.col(0) - X.col(5);
  Recycling recycling;
  teach(recycling, H, X);
  EXPECT_EQ(recycling.directions(), 4);
  const VectorXd v = VectorXd::Ones(size);
  EXPECT_LT(recycling.solved(v).norm(), 10 * v.norm());
}

TEST(Recycling, PutsNewPairsBeforeOldOnes) {
  const MatrixXd old = near_one(0, 0.05), now = near_one(0.3, 0.05), X = random_matrix(size, 7);
  Recycling recycling;
  teach(recycling, old, X);
  teach(recycling, now, X);
  for (Eigen::Index j = 0; j < X.cols(); ++j)
    EXPECT_LT((recycling.solved(now * X.col(j)) - X.col(j)).norm(), 1e-4 * X.col(j).norm());
}

TEST(Recycling, ForgetsAnotherSize) {
  const MatrixXd H = near_one(0, 0.05);
  const auto taught = [&](const VectorXd& next) {
    Recycling recycling;
    teach(recycling, H, random_matrix(size, 6));
    recycling.begin(next);
    return recycling.directions();
  };
  EXPECT_EQ(taught(VectorXd::Ones(size)), 6);
  EXPECT_EQ(taught(VectorXd::Zero(size)), 6) << "a solve without residual says nothing";
  EXPECT_EQ(taught(VectorXd::Ones(size - 3)), 0);
}

TEST(Recycling, DoesNotMoveWhatIsHeldNow) {
  Recycling recycling;
  const MatrixXd H = near_one(0, 0.05);
  teach(recycling, H, random_matrix(size, 6));
  VectorXd held = VectorXd::Random(size);
  held[17] = 0;
  EXPECT_NE(recycling.solved(held)[17], 0);
  recycling.begin(held);
  EXPECT_EQ(recycling.directions(), 6) << "an unknown that is zero by chance takes nothing else with it";
  EXPECT_EQ(recycling.solved(held)[17], 0);
}

TEST(Recycling, ForgetsWhatIsNotFinite) {
  Recycling recycling;
  teach(recycling, near_one(0), random_matrix(size, 6));
  VectorXd y = VectorXd::Ones(size);
  y[3] = std::nan("");
  recycling.note(VectorXd::Ones(size), y);
  recycling.learn();
  EXPECT_EQ(recycling.directions(), 0);
}

TEST(Recycling, GoesOnFromItsPackedFormBitForBit) {
  Recycling recycling, other;
  teach(recycling, near_one(0), random_matrix(size, 9));
  const std::vector<double> kept = recycling.packed();
  other.unpack(kept.data(), kept.data() + kept.size());
  EXPECT_EQ(other.packed(), kept);
  const VectorXd v = VectorXd::LinSpaced(size, -1, 1);
  EXPECT_EQ(other.solved(v), recycling.solved(v));
  const MatrixXd X = random_matrix(size, 5);
  teach(recycling, near_one(0.1), X);
  teach(other, near_one(0.1), X);
  EXPECT_EQ(other.packed(), recycling.packed());
}

}  // namespace recycling_test
}  // namespace tether
