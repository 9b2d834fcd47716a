#include "identification_master/reduced_order_filter.hpp"

#include <gtest/gtest.h>

#include "identification_master/identifiability.hpp"
#include "identification_master/sigma_points.hpp"
#include "tests/identification_master/linear_system.hpp"

namespace tether {
namespace {

using testing::KalmanFilter;
using testing::LinearSystem;
using testing::random_matrix;

constexpr int states = 6, data = 5;

TEST(SigmaPoints, AreUnitaryAndEquallyFar) {
  for (const int p : {1, 2, 4, 11, 60}) {
    const MatrixXd I = simplex_points(p);
    ASSERT_EQ(I.cols(), p + 1);
    EXPECT_LT(I.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12 * p);
    EXPECT_LT((I * I.transpose() / (p + 1) - MatrixXd::Identity(p, p)).cwiseAbs().maxCoeff(), 1e-13 * p);
    EXPECT_LT((I.colwise().norm().array() - std::sqrt(p)).abs().maxCoeff(), 1e-12 * p);
  }
}

/// A linear system, its Kalman filter and the particles of the reduced-order one, side by side.
struct Twins {
  std::mt19937 random;
  LinearSystem system;
  VectorXd truth_x, truth_theta;
  MatrixXd prior;
  KalmanFilter kalman;
  ReducedOrderFilter filter;
  MatrixXd X;
  double offset;  ///< that model and data share: large against what they differ by

  explicit Twins(int p, double offset = 0)
      : random(static_cast<unsigned>(p)),
        system(random, states, p, data),
        truth_x(random_matrix(random, states, 1)),
        truth_theta(random_matrix(random, p, 1)),
        prior([&] {
          const MatrixXd L = random_matrix(random, p, p) + 2 * MatrixXd::Identity(p, p);
          return MatrixXd(L * L.transpose());
        }()),
        kalman(system, truth_x, VectorXd::Zero(p), prior),
        filter(VectorXd::Zero(p), prior),
        X(truth_x.replicate(1, p + 1)),
        offset(offset) {}

  void predict() {
    truth_x = system.step(truth_x, truth_theta);
    kalman.predict();
    for (Eigen::Index i = 0; i < X.cols(); ++i) X.col(i) = system.step(X.col(i), filter.particles().col(i));
  }
  FilterCorrection correct() {
    const VectorXd errors = random_matrix(random, data, 1),
                   y = system.seen(truth_x, truth_theta) + errors.cwiseQuotient(system.precision.cwiseSqrt());
    kalman.correct(y);
    MatrixXd D(data, X.cols());
    for (Eigen::Index i = 0; i < X.cols(); ++i)
      D.col(i) = (y.array() + offset) - (system.seen(X.col(i), filter.particles().col(i)).array() + offset);
    FilterCorrection done = filter.correct(D, system.precision);
    X = (X * done.mix.transpose()).eval();
    return done;
  }
  void expect_equal(double tolerance) const {
    const Eigen::Index p = filter.parameters();
    const VectorXd x = ReducedOrderFilter::mean_of(X);
    const MatrixXd P = kalman.covariance.bottomRightCorner(p, p), L_x = ReducedOrderFilter::spread_of(X),
                   L_theta = ReducedOrderFilter::spread_of(filter.particles());
    EXPECT_LT((filter.mean() - kalman.mean.tail(p)).norm(), tolerance * kalman.mean.norm());
    EXPECT_LT((x - kalman.mean.head(states)).norm(), tolerance * kalman.mean.norm());
    EXPECT_LT((filter.covariance() - P).norm(), tolerance * prior.norm());
    EXPECT_LT((L_x * L_x.transpose() - kalman.covariance.topLeftCorner(states, states)).norm(),
              tolerance * prior.norm());
    EXPECT_LT((L_x * L_theta.transpose() - kalman.covariance.topRightCorner(states, p)).norm(),
              tolerance * prior.norm());
  }
};

TEST(ReducedOrderFilter, EqualsTheKalmanFilterOfALinearSystem) {
  for (const int p : {1, 2, 4, 11}) {
    Twins twins(p);
    for (int step = 0; step < 60; ++step) {
      twins.predict();
      const FilterCorrection done = twins.correct();
      EXPECT_NEAR(done.chi_square, twins.kalman.chi_square, 1e-8 * (1 + twins.kalman.chi_square));
      twins.expect_equal(1e-10);
    }
  }
}

TEST(ReducedOrderFilter, EqualsItWithGapsBetweenData) {
  for (const int p : {1, 2, 4, 11}) {
    Twins twins(p);
    for (int step = 0; step < 90; ++step) {
      const MatrixXd before = twins.filter.covariance();
      twins.predict();
      if (step % 7 == 3)
        twins.correct();
      else
        EXPECT_EQ(twins.filter.covariance(), before) << "without data the spread shrank by itself";
      twins.expect_equal(1e-10);
    }
  }
}

/// Distances of millimetres on vessels of metres: what model and data have in common must not cost digits.
TEST(ReducedOrderFilter, DoesNotLoseDigitsToALargeCommonPart) {
  Twins twins(4, 1e4);
  for (int step = 0; step < 60; ++step) {
    twins.predict();
    twins.correct();
  }
  twins.expect_equal(1e-8);  // y + 1e4 itself has an error of 1e-12
}

/// One parameter, one datum: theta ~ N(1, 4), y = 3 theta + e, e ~ N(0, 1/2), y = 9: by hand.
TEST(ReducedOrderFilter, MovesTowardTheDatum) {
  ReducedOrderFilter filter(VectorXd::Constant(1, 1.0), MatrixXd::Constant(1, 1, 4.0));
  const MatrixXd D = (9 - 3 * filter.particles().array()).matrix();
  const FilterCorrection done = filter.correct(D, VectorXd::Constant(1, 2.0));
  EXPECT_NEAR(filter.mean()(0), 1 + 4 * 3 / (9 * 4 + 0.5) * 6, 1e-13);
  EXPECT_NEAR(filter.covariance()(0, 0), 1 / (1 / 4.0 + 9 * 2), 1e-14);
  EXPECT_NEAR(done.chi_square, 36 / (9 * 4 + 0.5), 1e-13);
}

TEST(ReducedOrderFilter, IgnoresDataWithoutPrecision) {
  ReducedOrderFilter filter(VectorXd::Ones(2), MatrixXd::Identity(2, 2));
  const MatrixXd before = filter.particles();
  const FilterCorrection done = filter.correct(MatrixXd::Random(4, 3), VectorXd::Zero(4));
  EXPECT_LT((filter.particles() - before).norm(), 1e-14);
  EXPECT_LT((done.mix - MatrixXd::Identity(3, 3)).norm(), 1e-14);
}

TEST(ReducedOrderFilter, TempersAShiftThatIsTooLong) {
  std::mt19937 random(3);
  ReducedOrderFilter filter(VectorXd::Zero(3), MatrixXd::Identity(3, 3));
  const MatrixXd H = random_matrix(random, 8, 3), D = (-H * filter.particles()).colwise() + VectorXd::Constant(8, 50.0);
  const FilterCorrection done = filter.correct(D, VectorXd::Constant(8, 1e3), 1.5);
  EXPECT_NEAR(done.shift.norm(), 1.5, 1e-9);
  EXPECT_LT(done.tempering, 1);
  EXPECT_NEAR(filter.mean().norm(), 1.5, 1e-9);
}

TEST(ReducedOrderFilter, WalkAddsItsVariancesAndKeepsTheMean) {
  std::mt19937 random(5);
  const MatrixXd L = random_matrix(random, 4, 4), P = L * L.transpose() + MatrixXd::Identity(4, 4);
  const VectorXd mean = random_matrix(random, 4, 1), Q = VectorXd::LinSpaced(4, 0, 3);
  ReducedOrderFilter filter(mean, P);
  filter.diffuse(Q);
  EXPECT_LT((filter.covariance() - P - MatrixXd(Q.asDiagonal())).norm(), 1e-12 * P.norm());
  EXPECT_LT((filter.mean() - mean).norm(), 1e-13 * mean.norm());
}

TEST(ReducedOrderFilter, ForgettingWidensParametersAndStates) {
  ReducedOrderFilter filter(VectorXd::Ones(2), MatrixXd::Identity(2, 2));
  const MatrixXd X = MatrixXd::Random(5, 3),
                 mixed = X * filter.forget(0.5, 1e16 * MatrixXd::Identity(2, 2)).transpose();
  EXPECT_LT((filter.covariance() - 2 * MatrixXd::Identity(2, 2)).norm(), 1e-13);
  const MatrixXd S = ReducedOrderFilter::spread_of(X), wider = ReducedOrderFilter::spread_of(mixed);
  EXPECT_LT((wider - std::sqrt(2.0) * S).norm(), 1e-13);
  EXPECT_LT((ReducedOrderFilter::mean_of(mixed) - ReducedOrderFilter::mean_of(X)).norm(), 1e-14);
}

TEST(ReducedOrderFilter, ForgetsWhatWasLearnedAndNotThePrior) {
  std::mt19937 random(9);
  const MatrixXd L = random_matrix(random, 3, 3), prior = L * L.transpose() + MatrixXd::Identity(3, 3);
  ReducedOrderFilter filter(VectorXd::Ones(3), prior);
  filter.forget(0.5, prior);
  EXPECT_LT((filter.covariance() - prior).norm(), 1e-12 * prior.norm()) << "nothing was learned yet";

  const MatrixXd H = random_matrix(random, 5, 3);
  filter.correct(-H * filter.particles(), VectorXd::Ones(5));
  const VectorXd mean = filter.mean();
  const MatrixXd learned = filter.covariance().inverse() - prior.inverse();
  filter.forget(0.25, prior);
  EXPECT_LT((filter.covariance().inverse() - prior.inverse() - 0.25 * learned).norm(), 1e-10 * learned.norm());
  EXPECT_LT((filter.mean() - mean).norm(), 1e-12);
}

/// The prior's information is 1 each; the data add J.
VectorXd retained(const MatrixXd& J) {
  const MatrixXd prior = MatrixXd::Identity(2, 2);
  return identifiability(prior, (prior + J).inverse()).retained;
}

TEST(Identifiability, WhatOthersCanSayAsWellIsNotRetained) {
  const VectorXd alone = retained(Eigen::Vector2d(3, 8).asDiagonal()),
                 alike = retained((MatrixXd(2, 2) << 8, 7.9, 7.9, 8).finished());
  EXPECT_NEAR(alone(0), 1, 1e-12);
  EXPECT_NEAR(alone(1), 1, 1e-12);
  EXPECT_NEAR(alike(0), (8 - 7.9 * 7.9 / 9) / 8, 1e-12);
}

TEST(Identifiability, NumbersWithoutEffectRetainNothing) {
  const VectorXd found = retained((MatrixXd(2, 2) << 0.04, 0.02, 0.02, 8).finished());
  EXPECT_EQ(found(0), 0);
  EXPECT_GT(found(1), 0.99);
}

}  // namespace
}  // namespace tether
