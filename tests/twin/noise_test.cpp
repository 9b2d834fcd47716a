#include "twin/noise.hpp"

#include <gtest/gtest.h>

namespace tether {
namespace {

constexpr int trials = 4000;
/// Four standard deviations of a correlation estimated from so many trials.
const double tolerance = 4 / std::sqrt(trials);

/// Products of the values at pairs of columns, averaged over seeds: 1 on the diagonal, correlations beside it.
Eigen::MatrixXd covariance(const std::function<VectorXd(std::uint64_t)>& values) {
  Eigen::MatrixXd sum;
  for (int seed = 0; seed < trials; ++seed) {
    const VectorXd v = values(static_cast<std::uint64_t>(seed));
    if (sum.size() == 0) sum.setZero(v.size(), v.size());
    sum += v * v.transpose() / trials;
  }
  return sum;
}

TEST(RandomField, HasTheStatedCorrelationInAllDirections) {
  const double length = 0.7;
  Points x = Points::Zero(3, 5);
  x.col(1) = Vec3(0.1, 0, 0);
  x.col(2) = length * Vec3(1, 1, 1).normalized();
  x.col(3) = 2 * length * Vec3(0, -1, 1).normalized();
  x.col(4) = Vec3(0, 0, 30);
  const Eigen::MatrixXd c = covariance([&](std::uint64_t seed) { return RandomField(length, Random(seed, 3))(x); });
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j)
      EXPECT_NEAR(c(i, j), std::exp(-(x.col(i) - x.col(j)).norm() / length), (i == j ? std::sqrt(2) : 1) * tolerance)
          << i << " " << j;
}

TEST(RandomField, HasAGaussianCorrelationIfWanted) {
  Points x = Points::Zero(3, 4);
  x.col(1) = Vec3(0.3, 0, 0), x.col(2) = Vec3(0, 0.7, 0), x.col(3) = Vec3(0, 0, 1.5);
  const Eigen::MatrixXd c =
      covariance([&](std::uint64_t seed) { return RandomField(0.7, Random(seed, 3), CorrelationShape::gaussian)(x); });
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = 0; j < 4; ++j)
      EXPECT_NEAR(c(i, j), std::exp(-(x.col(i) - x.col(j)).squaredNorm() / (2 * 0.7 * 0.7)),
                  (i == j ? std::sqrt(2) : 1) * tolerance)
          << i << " " << j;
}

TEST(RandomField, WithoutALengthIsAlikeNowhere) {
  const Eigen::MatrixXd c =
      covariance([](std::uint64_t seed) { return RandomField(0, Random(seed, 0))(Points::Zero(3, 4)); });
  EXPECT_LT((c - Eigen::MatrixXd::Identity(4, 4)).cwiseAbs().maxCoeff(), std::sqrt(2) * tolerance);
}

TEST(RandomField, OfManyPlacesHasTheStatedDeviation) {
  Points x(3, 20000);  // a line of 2000 correlation lengths: one field alone
  for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) = Vec3(0.1 * static_cast<double>(i), 0, 0);
  const VectorXd values = RandomField(1, Random(5, 0))(x);
  EXPECT_NEAR(values.mean(), 0, 4 * std::sqrt(2.0 / 2000));
  EXPECT_NEAR(values.squaredNorm() / 20000, 1, 0.2);
}

TEST(NoiseSeries, IsAlikeInNeighbouringFrames) {
  const std::vector<double> times{0, 0.1, 0.3};
  const Points x = Points::Zero(3, 1);
  const auto values = [&](double correlation_time) {
    return covariance([&, correlation_time](std::uint64_t seed) {
      const NoiseSeries noise({2, 1, correlation_time}, times, seed);
      return VectorXd(Vec3(noise(0, x)[0], noise(1, x)[0], noise(2, x)[0]));
    });
  };
  const Eigen::MatrixXd alike = values(0.2), alone = values(0);
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j) {
      const double apart = std::abs(times[static_cast<std::size_t>(i)] - times[static_cast<std::size_t>(j)]);
      EXPECT_NEAR(alike(i, j), 4 * std::exp(-apart / 0.2), 4 * std::sqrt(2) * tolerance);
      EXPECT_NEAR(alone(i, j), i == j ? 4 : 0, 4 * std::sqrt(2) * tolerance);
    }
}

TEST(NoiseOverTime, IsAlikeInNeighbouringValues) {
  const std::vector<double> times{0, 0.01, 0.05};
  const Eigen::MatrixXd c = covariance([&](std::uint64_t seed) { return noise_over_time({3, 0, 0.02}, times, seed); });
  EXPECT_NEAR(c(0, 0), 9, 9 * std::sqrt(2) * tolerance);
  EXPECT_NEAR(c(2, 2), 9, 9 * std::sqrt(2) * tolerance);
  EXPECT_NEAR(c(0, 1), 9 * std::exp(-0.5), 9 * tolerance);
  EXPECT_NEAR(c(1, 2), 9 * std::exp(-2), 9 * tolerance);
}

}  // namespace
}  // namespace tether
