/// How large the noise is, as the data say where no effect could be seen.
#include "diagnosis/evidence/noise_factors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tether {
namespace noise_factors_test {

using Index = Eigen::Index;

constexpr Index data = 600, other_data = 100;

/// Data of two sources, the second of few; candidates, allowed errors and patterns at random. factor: of the first
/// source's noise.
EffectProblem drawn(unsigned seed, double factor) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  const auto random = [&](Index columns) {
    return MatrixXd::NullaryExpr(data + other_data, columns, [&] { return normal(generator); });
  };
  EffectProblem made;
  made.changes = random(20);
  made.allowed = random(5);
  made.patterns = random(30);
  made.residual = random(1);
  made.residual.head(data) *= factor;
  made.residual += 2 * made.changes.col(3) + 5 * made.patterns.col(7) + made.allowed.col(1);
  made.precision = made.independent = VectorXd::Ones(data + other_data);
  for (Index i = 0; i < data + other_data; ++i) (i % 5 == 0 ? made.held_out : made.training).push_back(i);
  return made;
}

constexpr NoiseBand first{0, false}, second{1, false}, first_long{0, true};

std::vector<NoiseBand> bands() {
  std::vector<NoiseBand> all(data, first);
  all.resize(data + other_data, second);
  return all;
}

TEST(NoiseFactors, AreThoseOfEachSourceWhateverIsMissing) {
  double of_first = 0, of_second = 0;
  constexpr int draws = 20;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const NoiseFactors found = noise_factors(drawn(seed, 1.2), bands());
    ASSERT_EQ(found.size(), 2U);
    of_first += found.at(first) / draws;
    of_second += found.at(second) / draws;
  }
  EXPECT_NEAR(of_first, 1.2, 0.02);
  EXPECT_NEAR(of_second, 1.03, 0.03) << "half of the draws are not below 1";
}

TEST(NoiseFactors, StayWithinTheirBounds) {
  EXPECT_EQ(noise_factors(drawn(1, 0.5), bands()).at(first), 1);
  EXPECT_EQ(noise_factors(drawn(1, 3), bands()).at(first), largest_noise_factor);
}

/// Errors that are alike farther than stated are larger in long waves only.
TEST(NoiseFactors, TellLongWavesFromOthers) {
  std::vector<NoiseBand> all = bands();
  EffectProblem problem = drawn(4, 1);
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  for (Index i = 0; i < data / 2; ++i) {
    all[static_cast<std::size_t>(i)] = first_long;
    problem.residual(i) += std::sqrt(1.7 * 1.7 - 1) * normal(generator);
  }
  const NoiseFactors found = noise_factors(problem, all);
  EXPECT_NEAR(found.at(first_long), 1.7, 0.15);
  EXPECT_NEAR(found.at(first), 1, 0.1);
  for (Index i = 0; i < data / 2; ++i) problem.residual(i) += 3 * normal(generator);
  EXPECT_EQ(noise_factors(problem, all).at(first_long), largest_of_long_waves);
}

TEST(NoiseFactors, DoNotLookAtWhatIsSealed) {
  EffectProblem problem = drawn(2, 1.1);
  problem.sealed = problem.held_out;
  const double before = noise_factors(problem, bands()).at(first);
  for (const Index i : problem.sealed) problem.residual(i) = 100;
  EXPECT_DOUBLE_EQ(noise_factors(problem, bands()).at(first), before);
}

TEST(NoiseFactors, MakeDataOfDeviationOne) {
  const EffectProblem problem = drawn(3, 1.2),
                      scaled = with_noise(problem, larger_noise(bands(), {{first, 1.2}, {second, 1}}));
  EXPECT_LT((1.2 * scaled.residual.head(data) - problem.residual.head(data)).norm(), 1e-12);
  EXPECT_LT((1.2 * scaled.patterns.topRows(data) - problem.patterns.topRows(data)).norm(), 1e-12);
  EXPECT_EQ(scaled.changes.bottomRows(other_data), problem.changes.bottomRows(other_data));
}

}  // namespace noise_factors_test
}  // namespace tether
