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

std::vector<std::size_t> sources() {
  std::vector<std::size_t> all(data, 0);
  all.resize(data + other_data, 1);
  return all;
}

TEST(NoiseFactors, AreThoseOfEachSourceWhateverIsMissing) {
  double first = 0, second = 0;
  constexpr int draws = 20;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const std::vector<double> found = noise_factors(drawn(seed, 1.2), sources());
    ASSERT_EQ(found.size(), 2U);
    first += found[0] / draws;
    second += found[1] / draws;
  }
  EXPECT_NEAR(first, 1.2, 0.02);
  EXPECT_NEAR(second, 1.03, 0.03) << "half of the draws are not below 1";
}

TEST(NoiseFactors, StayWithinTheirBounds) {
  EXPECT_EQ(noise_factors(drawn(1, 0.5), sources())[0], 1);
  EXPECT_EQ(noise_factors(drawn(1, 3), sources())[0], largest_noise_factor);
}

TEST(NoiseFactors, DoNotLookAtWhatIsSealed) {
  EffectProblem problem = drawn(2, 1.1);
  problem.sealed = problem.held_out;
  const double before = noise_factors(problem, sources())[0];
  for (const Index i : problem.sealed) problem.residual(i) = 100;
  EXPECT_DOUBLE_EQ(noise_factors(problem, sources())[0], before);
}

TEST(NoiseFactors, MakeDataOfDeviationOne) {
  const EffectProblem problem = drawn(3, 1.2), scaled = with_noise(problem, sources(), {1.2, 1});
  EXPECT_LT((1.2 * scaled.residual.head(data) - problem.residual.head(data)).norm(), 1e-12);
  EXPECT_LT((1.2 * scaled.patterns.topRows(data) - problem.patterns.topRows(data)).norm(), 1e-12);
  EXPECT_EQ(scaled.changes.bottomRows(other_data), problem.changes.bottomRows(other_data));
}

}  // namespace noise_factors_test
}  // namespace tether
