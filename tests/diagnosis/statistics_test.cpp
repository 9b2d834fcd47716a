#include "diagnosis/comparison/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/comparison/run_motion.hpp"

namespace tether {
namespace {

Sample sample(double distance, double weight, Exclusion excluded = Exclusion::none) {
  Sample one;
  one.distance = distance;
  one.weight = excluded == Exclusion::none ? weight : 0;
  one.excluded = excluded;
  return one;
}

TEST(Statistics, OfFourSamplesByHand) {
  Distances distances;
  for (const Sample& one : {sample(1, 1), sample(-2, 2), sample(3, 1), sample(9, 5, Exclusion::rim)})
    distances.add(one);
  const Statistics s = distances.statistics();
  EXPECT_EQ(s.used(), 3);
  EXPECT_EQ(s.counts[static_cast<std::size_t>(Exclusion::rim)], 1);
  EXPECT_DOUBLE_EQ(s.extent, 4);
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt((1 + 8 + 9) / 4.0));
  EXPECT_DOUBLE_EQ(s.unnormalised, std::sqrt(18.0));
  EXPECT_DOUBLE_EQ(s.largest, 3);
  EXPECT_DOUBLE_EQ(s.mean, 0);
  EXPECT_DOUBLE_EQ(s.p95, 3);
}

TEST(Statistics, ThePercentileCountsWeightNotSamples) {
  Distances distances;
  for (int i = 0; i < 10; ++i) distances.add(sample(-10 - i, 0.004));  // many samples, little area
  distances.add(sample(2, 0.94));
  distances.add(sample(-3, 0.02));
  EXPECT_DOUBLE_EQ(distances.statistics().p95, 3);
}

TEST(Statistics, OfNothingAreZero) {
  Distances distances;
  distances.add(sample(1, 1, Exclusion::masked));
  const Statistics s = distances.statistics();
  EXPECT_EQ(s.used(), 0);
  EXPECT_EQ(s.rms, 0);
  EXPECT_EQ(s.extent, 0);
}

TEST(EffectiveNumber, IsBetweenOneAndTheNumberOfSamples) {
  EXPECT_DOUBLE_EQ(effective_number(60, 1, 6, 64), 5);
  EXPECT_DOUBLE_EQ(effective_number(100, 2, 1, 1000), 100 / (2 * M_PI));
  EXPECT_DOUBLE_EQ(effective_number(5, 1, 6, 64), 1);
  EXPECT_DOUBLE_EQ(effective_number(60, 1, 1e-3, 64), 64);
  EXPECT_DOUBLE_EQ(effective_number(60, 1, 0, 64), 64);
  EXPECT_DOUBLE_EQ(effective_number(0, 1, 6, 0), 0);
}

/// Errors along a closed line with the correlation exp(-|r|/l): the variance of their mean is 1/n of one's.
TEST(EffectiveNumber, IsThatOfExponentiallyCorrelatedErrors) {
  constexpr int count = 200, trials = 4000;
  constexpr double length = 20, correlation = 0.5, step = length / count;
  const double keep = std::exp(-step / correlation);
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double variance = 0;
  for (int trial = 0; trial < trials; ++trial) {
    double error = normal(random), mean = 0;
    for (int i = 0; i < count; ++i) {
      mean += error / count;
      error = keep * error + std::sqrt(1 - keep * keep) * normal(random);
    }
    variance += mean * mean / trials;
  }
  EXPECT_NEAR(1 / variance, effective_number(length, 1, correlation, count), 0.1 / variance);
}

TEST(Quantiles, OfTablesOfTheNormalAndChiSquareDistributions) {
  EXPECT_NEAR(normal_quantile(0.5), 0, 1e-10);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963985, 1e-8);
  EXPECT_NEAR(normal_quantile(1 - 1e-6), 4.753424, 1e-5);
  EXPECT_NEAR(10 * mean_square_quantile(10, 1.6448536), 18.307, 0.03);
  EXPECT_NEAR(3 * mean_square_quantile(3, 2.3263479), 11.345, 0.15);
}

TEST(TimeInRun, IsInTheLastPeriodThatTheRunCovers) {
  EXPECT_DOUBLE_EQ(*time_in_run(0.25, 1, 0, 3.5, 0), 3.25);
  EXPECT_DOUBLE_EQ(*time_in_run(0.75, 1, 0, 3.5, 0), 2.75);
  EXPECT_DOUBLE_EQ(*time_in_run(-0.25, 1, 0, 1, 0), 0.75);
  EXPECT_DOUBLE_EQ(*time_in_run(0, 1, 0, 1, 0), 1);
  EXPECT_DOUBLE_EQ(*time_in_run(1e-3, 1, 0, 1, 2e-3), 1);
  EXPECT_FALSE(time_in_run(0.75, 1, 0, 0.5, 1e-3));
  EXPECT_DOUBLE_EQ(*time_in_run(0.25, 0, 0, 3.5, 0), 0.25);
  EXPECT_FALSE(time_in_run(3.6, 0, 0, 3.5, 0.01));
  EXPECT_FALSE(time_in_run(-0.1, 0, 0, 3.5, 0.01));
  EXPECT_DOUBLE_EQ(*time_in_run(std::nan(""), 0, 0, 3.5, 0), 3.5);
}

}  // namespace
}  // namespace tether
