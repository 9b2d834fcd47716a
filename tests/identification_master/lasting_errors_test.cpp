// Errors of data that are the same at all times, found beside the parameters without particles of their own.
#include "identification_master/lasting_errors.hpp"

#include <gtest/gtest.h>

#include "identification_master/reduced_order_filter.hpp"
#include "tests/identification_master/linear_system.hpp"

namespace tether {
namespace lasting_errors_test {

using testing::KalmanFilter;
using testing::LinearSystem;
using testing::random_matrix;

constexpr int states = 6, data = 9;

/// theta and b, of which b moves nothing and is seen through N.
LinearSystem with_errors(LinearSystem system, const MatrixXd& N) {
  system.B.conservativeResize(Eigen::NoChange, system.B.cols() + N.cols());
  system.B.rightCols(N.cols()).setZero();
  system.K.conservativeResize(Eigen::NoChange, system.K.cols() + N.cols());
  system.K.rightCols(N.cols()) = N;
  return system;
}

MatrixXd beside(const MatrixXd& prior, Eigen::Index q) {
  MatrixXd all = MatrixXd::Identity(prior.rows() + q, prior.rows() + q);
  all.topLeftCorner(prior.rows(), prior.rows()) = prior;
  return all;
}

/// The filter with p + 1 particles beside the Kalman filter of states, parameters and q errors.
struct Twins {
  std::mt19937 random;
  LinearSystem system;
  MatrixXd N, prior;
  LinearSystem whole;
  VectorXd truth_x, truth_theta, b;
  KalmanFilter kalman;
  ReducedOrderFilter filter;
  MatrixXd X;

  Twins(int p, int q)
      : random(static_cast<unsigned>(7 * p + q)),
        system(random, states, p, data),
        N(random_matrix(random, data, q)),
        prior(MatrixXd::Identity(p, p) + 0.3 * MatrixXd::Ones(p, p)),
        whole(with_errors(system, N)),
        truth_x(random_matrix(random, states, 1)),
        truth_theta(random_matrix(random, p, 1)),
        b(random_matrix(random, q, 1)),
        kalman(whole, truth_x, VectorXd::Zero(p + q), beside(prior, q)),
        filter(VectorXd::Zero(p), prior, N),
        X(truth_x.replicate(1, p + 1)) {}

  void predict() {
    truth_x = system.step(truth_x, truth_theta);
    kalman.predict();
    for (Eigen::Index i = 0; i < X.cols(); ++i) X.col(i) = system.step(X.col(i), filter.particles().col(i));
  }
  FilterCorrection correct() {
    const VectorXd errors = random_matrix(random, data, 1);
    const VectorXd y = system.seen(truth_x, truth_theta) + N * b + errors.cwiseQuotient(system.precision.cwiseSqrt());
    kalman.correct(y);
    MatrixXd D(data, X.cols());
    for (Eigen::Index i = 0; i < X.cols(); ++i) D.col(i) = y - system.seen(X.col(i), filter.particles().col(i));
    FilterCorrection done = filter.correct(D, system.precision);
    X = (X * done.mix.transpose()).eval();
    return done;
  }
  void renew(const std::vector<Eigen::Index>& errors) {
    for (const Eigen::Index error : errors) {
      const Eigen::Index k = states + filter.parameters() + error;
      b(error) = random_matrix(random, 1, 1)(0);
      kalman.mean(k) = 0;
      kalman.covariance.row(k).setZero();
      kalman.covariance.col(k).setZero();
      kalman.covariance(k, k) = 1;
    }
    filter.errors_now(N, errors);
  }
  void walk(const VectorXd& variances) {
    filter.diffuse(variances);
    kalman.covariance.diagonal().segment(states, filter.parameters()) += variances;
  }
  void expect_equal(double tolerance) const {
    const Eigen::Index p = filter.parameters(), q = N.cols();
    const MatrixXd& P = kalman.covariance;
    const MatrixXd L_x = ReducedOrderFilter::spread_of(X), L_theta = ReducedOrderFilter::spread_of(filter.particles());
    const LastingErrors& found = filter.lasting();
    EXPECT_LT((filter.mean() - kalman.mean.segment(states, p)).norm(), tolerance * kalman.mean.norm());
    EXPECT_LT((ReducedOrderFilter::mean_of(X) - kalman.mean.head(states)).norm(), tolerance * kalman.mean.norm());
    EXPECT_LT((found.mean - kalman.mean.tail(q)).norm(), tolerance * kalman.mean.norm());
    EXPECT_LT((filter.covariance() - P.block(states, states, p, p)).norm(), tolerance);
    EXPECT_LT((L_x * L_x.transpose() - P.topLeftCorner(states, states)).norm(), tolerance * P.norm());
    EXPECT_LT((found.whole_covariance() - P.bottomRightCorner(q, q)).norm(), tolerance);
    EXPECT_LT((L_theta * found.slope.transpose() - P.block(states, states + p, p, q)).norm(), tolerance);
    EXPECT_LT((L_x * found.slope.transpose() - P.topRightCorner(states, q)).norm(), tolerance * P.norm());
  }
};

TEST(LastingErrors, AreFoundAsTheKalmanFilterOfAllFindsThem) {
  for (const int p : {1, 3, 6})
    for (const int q : {1, 4, 8}) {
      Twins twins(p, q);
      for (int step = 0; step < 60; ++step) {
        twins.predict();
        if (step % 3 == 2) continue;
        const FilterCorrection done = twins.correct();
        EXPECT_NEAR(done.chi_square, twins.kalman.chi_square, 1e-8 * (1 + twins.kalman.chi_square)) << p << " " << q;
        twins.expect_equal(1e-9);
      }
    }
}

/// Those of single frames, of which others come in their place.
TEST(LastingErrors, BeginAnewWithTheirFrame) {
  Twins twins(3, 5);
  for (int step = 0; step < 60; ++step) {
    twins.predict();
    if (step % 4 == 0) twins.renew({1, 2});
    if (step % 6 == 2) twins.renew({4});
    twins.correct();
    twins.expect_equal(1e-9);
  }
}

/// States and parameters part where parameters walk (K.6): compared is what the filter keeps, that of the parameters.
TEST(LastingErrors, StayCorrelatedWithParametersThatWalk) {
  std::mt19937 random(2);
  const LinearSystem system(random, states, 3, data);
  const MatrixXd N = random_matrix(random, data, 4);
  ReducedOrderFilter filter(VectorXd::Zero(3), MatrixXd::Identity(3, 3), N);
  MatrixXd P = MatrixXd::Identity(7, 7), J(data, 7);
  J << system.K, N;
  for (int step = 0; step < 5; ++step) {
    filter.correct(-system.K * filter.particles(), system.precision);
    P = MatrixXd(P.inverse() + J.transpose() * system.precision.asDiagonal() * J).inverse();
    filter.diffuse(Eigen::Vector3d(0.1, 0, 0.4));
    P.diagonal().head(3) += Eigen::Vector3d(0.1, 0, 0.4);
    const MatrixXd L = ReducedOrderFilter::spread_of(filter.particles());
    EXPECT_LT((filter.covariance() - P.topLeftCorner(3, 3)).norm(), 1e-11);
    EXPECT_LT((L * filter.lasting().slope.transpose() - P.topRightCorner(3, 4)).norm(), 1e-11);
    EXPECT_LT((filter.lasting().whole_covariance() - P.bottomRightCorner(4, 4)).norm(), 1e-11);
  }
}

/// What is forgotten of the parameters is not forgotten of the errors.
TEST(LastingErrors, AreNotForgotten) {
  Twins twins(3, 4);
  for (int step = 0; step < 4; ++step) twins.predict(), twins.correct();
  const MatrixXd before = twins.filter.lasting().whole_covariance(), theta = twins.filter.covariance();
  twins.filter.forget(0.5, twins.prior);
  EXPECT_LT((twins.filter.lasting().whole_covariance() - before).norm(), 1e-12);
  EXPECT_GT(twins.filter.covariance().trace(), 1.1 * theta.trace());
}

TEST(LastingErrors, TempersAShiftThatIsTooLong) {
  Twins twins(3, 4);
  const MatrixXd D = (-twins.system.K * twins.filter.particles()).colwise() + VectorXd::Constant(data, 50.0);
  const FilterCorrection done = twins.filter.correct(D, VectorXd::Constant(data, 1e3), 1.5);
  EXPECT_NEAR(done.shift.norm(), 1.5, 1e-9);
  EXPECT_LT(done.tempering, 1);
}

/// Ten frames that all err alike beside their noise: 400 draws of one parameter. With the errors known of, its
/// deviation is right; without, it is too small by what can be computed.
TEST(LastingErrors, MakeHonestIntervalsOfDataThatErrAlike) {
  std::mt19937 random(3);
  const VectorXd s = random_matrix(random, data, 1);
  const MatrixXd N = random_matrix(random, data, 2);
  double knowing = 0, ignorant = 0, variance = 0;
  constexpr int draws = 400;
  for (int draw = 0; draw < draws; ++draw) {
    const VectorXd theta = random_matrix(random, 1, 1), off = N * random_matrix(random, 2, 1);
    ReducedOrderFilter with(VectorXd::Zero(1), MatrixXd::Identity(1, 1), N),
        without(VectorXd::Zero(1), MatrixXd::Identity(1, 1));
    for (int frame = 0; frame < 10; ++frame) {
      const VectorXd y = s * theta + off + random_matrix(random, data, 1);
      for (ReducedOrderFilter* filter : {&with, &without})
        filter->correct((-s * filter->particles()).colwise() + y, VectorXd::Ones(data));
    }
    knowing += std::pow(with.mean()(0) - theta(0), 2) / with.covariance()(0, 0) / draws;
    ignorant += std::pow(without.mean()(0) - theta(0), 2) / without.covariance()(0, 0) / draws;
    variance = without.covariance()(0, 0);
  }
  EXPECT_NEAR(knowing, 1, 3 * std::sqrt(2.0 / draws));
  const double truly = variance + (10 * variance * N.transpose() * s).squaredNorm();
  EXPECT_NEAR(ignorant * variance / truly, 1, 3 * std::sqrt(2.0 / draws));
  EXPECT_GT(ignorant, 2);
}

}  // namespace lasting_errors_test
}  // namespace tether
