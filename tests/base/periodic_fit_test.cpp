#include "common/base/periodic_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/base/error.hpp"

namespace tether {
namespace periodic_fit_test {

constexpr double period = 0.9, pi = std::numbers::pi;

Vec3 truth(double time) {
  const double w = 2 * pi * time / period;
  return {1 + std::cos(w), 0.5 * std::sin(2 * w) - 2, 0.1 * std::cos(3 * w)};
}

std::vector<double> frames(int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(period * i / count);
  return times;
}

MatrixXd samples(const std::vector<double>& times, double noise = 0) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 1);
  MatrixXd values(3, static_cast<Eigen::Index>(times.size()));
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    values.col(i) = truth(times[static_cast<std::size_t>(i)]);
    for (double& value : values.col(i)) value += noise * normal(generator);
  }
  return values;
}

double largest_error(const PeriodicFit& fit) {
  double worst = 0;
  for (double time = -period; time < 2 * period; time += 0.013)
    worst = std::max(worst, (fit(time) - truth(time)).norm());
  return worst;
}

TEST(PeriodicFit, RecoversASeries) {
  const auto times = frames(25);
  const PeriodicFit fit(times, samples(times), period, 3);
  EXPECT_LT(largest_error(fit), 1e-12);
  EXPECT_LT(fit.residual(), 1e-12);
}

TEST(PeriodicFit, TellsTheNoiseAndAveragesIt) {
  const auto times = frames(100);
  const double noise = 0.1;
  const PeriodicFit fit(times, samples(times, noise), period, 3);
  const double left = 93.0 / 100;  // 7 of 100 degrees of freedom are fitted
  EXPECT_NEAR(fit.residual(), noise * std::sqrt(3 * left), 0.1 * noise * std::sqrt(3));
  EXPECT_LT(largest_error(fit), 5 * noise * std::sqrt(3 * 7.0 / 100));
}

TEST(PeriodicFit, IsNotBentByOneSampleFarOff) {
  const auto times = frames(25);
  MatrixXd values = samples(times, 0.01);
  const double honest = largest_error(PeriodicFit(times, values, period, 3));
  values.col(6) += Vec3(1, 1, 0);
  EXPECT_LT(largest_error(PeriodicFit(times, values, period, 3)), 2 * honest) << "least squares errs by some 0.4";
}

TEST(PeriodicFit, RefusesTooFewPhases) {
  const auto times = frames(5);
  EXPECT_NO_THROW(PeriodicFit(times, samples(times), period, 2));
  EXPECT_THROW(PeriodicFit(times, samples(times), period, 3), InputError);
}

}  // namespace periodic_fit_test
}  // namespace tether
