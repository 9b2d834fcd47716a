/// What data foretell: each moment the others', an effect its name, a further measurement which of two it is.
#include <gtest/gtest.h>

#include "diagnosis/results/further_data.hpp"
#include "diagnosis/search/detectable.hpp"
#include "diagnosis/search/further_measurement.hpp"
#include "diagnosis/search/phase_gain.hpp"
#include "tests/diagnosis/band.hpp"

namespace tether {
namespace effect_search_test {

/// Each moment from all others: what is there foretells, what noise looks like does not.
TEST(PhaseGain, WhatIsThereForetellsEachMoment) {
  EffectProblem problem = band(true);
  const auto gain = [&](double size, std::mt19937_64& generator) {
    std::normal_distribution<double> normal;
    problem.residual = size * problem.changes.col(2);
    for (double& datum : problem.residual) datum += normal(generator);
    return phase_gain(problem, {}, {2}, {}).value();
  };
  std::mt19937_64 generator(29);
  const PhaseGain found = gain(2, generator);
  EXPECT_EQ(found.moments, moments);
  EXPECT_GT(found.better, moments / 2);
  EXPECT_GT(found.positive, 0.99);
  EXPECT_GT(found.robust, 0);
  EXPECT_LT(found.robust, found.value);
  EXPECT_LE(share([&](auto& g) { return gain(0, g).positive > 0.95; }, 100), 0.05);
  problem.moment.assign(problem.moment.size(), 0);
  EXPECT_FALSE(phase_gain(problem, {}, {2}, {}).has_value()) << "no other moment says anything";
}

/// What is expected of normal gains is what drawn ones have in the mean.
TEST(PhaseGain, IsExpectedAsItIsDrawn) {
  constexpr int count = 10, trials = 20000;
  constexpr double mean = 1.2, deviation = 1.5;
  std::mt19937_64 generator(41);
  std::normal_distribution<double> normal(mean, deviation);
  double robust = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> each(count);
    for (double& gain : each) gain = normal(generator);
    std::sort(each.begin(), each.end());
    robust += std::accumulate(each.begin(), each.begin() + 8, 0.0) / trials;
  }
  const PhaseGain expected = expected_gain(count * mean, std::sqrt(count) * deviation, count);
  EXPECT_NEAR(expected.robust, robust, 0.1 * robust) << "of ten numbers as of many";
  EXPECT_GT(expected.positive, 0.95) << "12 of deviation 4.7, Student's t of 9 degrees of freedom";
  EXPECT_TRUE(foretells(expected));
  EXPECT_FALSE(foretells(expected_gain(count * mean, 3 * std::sqrt(count) * deviation, count)));
}

constexpr double strong = 10;

/// Groups of the band with "late", which does much the same as the third spring; each was run alone.
Weighing weighed_with_late(const EffectProblem& problem) {
  std::vector<ShownRun> runs;
  for (const Index c : {Index{4}, problem.changes.cols() - 1}) {
    const VectorXd amplitudes = strong * VectorXd::Unit(problem.changes.cols(), c);
    runs.push_back({amplitudes, problem.residual - problem.changes * amplitudes});
  }
  const SetEvidence evidence(problem, runs);
  const Posterior posterior = posterior_of(problem, evidence, std::vector<bool>(problem.candidates.size(), false));
  Weighed all = weighed(problem, evidence, posterior);
  foretell_moments(all, problem, runs, posterior);
  all.detectable.assign(problem.candidates.size(), 1.0);
  return {all, runs};
}

/// The largest fifth of the terms, rounded up, does not count: here there is one moment that says anything.
TEST(PhaseGain, OneMomentIsNotRobust) {
  EffectProblem problem = band(true);
  std::mt19937_64 generator(37);
  std::normal_distribution<double> normal;
  problem.residual = VectorXd::Zero(problem.changes.rows());
  problem.residual.segment(3 * places, places) = strong * problem.changes.col(2).segment(3 * places, places);
  for (double& datum : problem.residual) datum += normal(generator);
  const PhaseGain gain = phase_gain(problem, {}, {2}, {}).value();
  EXPECT_LT(gain.robust, std::log(49));
  EXPECT_LT(gain.robust, gain.value);
}

/// What two moments alone speak for is not told from what does much the same, as sure as the noise makes it.
TEST(PhaseGain, FewMomentsTellNoLookAlikesApart) {
  EffectProblem problem = band(true);
  add_candidate(problem, "late", response(2, 8, [](int m) { return std::pow(beat(m), 1.6); }));
  const std::size_t spring = 4, late = problem.candidates.size() - 1;
  std::mt19937_64 generator(31);
  std::normal_distribution<double> normal;
  const auto data_of = [&](std::size_t what) {
    problem.residual = strong * problem.changes.col(static_cast<Index>(what));
    for (double& datum : problem.residual) datum += normal(generator);
  };
  data_of(spring);
  for (const Index m : {2, 10})  // are off as the other one is
    problem.residual.segment(m * places, places) +=
        1.2 * strong *
        (problem.changes.col(static_cast<Index>(late)) - problem.changes.col(static_cast<Index>(spring)))
            .segment(m * places, places);
  const Weighed few = weighed_with_late(problem).weighed;
  ASSERT_FALSE(few.groups.empty());
  ASSERT_EQ(few.groups[0].members[0], late);
  EXPECT_GT(few.groups[0].shares[0], 0.98);
  ASSERT_TRUE(few.groups[0].has(spring));
  EXPECT_TRUE(few.groups[0].as_good[1]);

  data_of(late);
  const Weighed all = weighed_with_late(problem).weighed;
  ASSERT_EQ(all.groups[0].members[0], late);
  for (std::size_t k = 1; k < all.groups[0].members.size(); ++k) EXPECT_FALSE(all.groups[0].as_good[k]);
}

/// Both are told where one only is run again.
TEST(PhaseGain, AllThatMomentsDoNotTellApartAreTold) {
  EffectProblem problem = band(true);
  add_candidate(problem, "late", response(2, 8, [](int m) { return std::pow(beat(m), 1.6); }));
  const std::size_t spring = 4, late = problem.candidates.size() - 1;
  std::mt19937_64 generator(31);
  std::normal_distribution<double> normal;
  problem.residual = strong * problem.changes.col(static_cast<Index>(late));
  for (double& datum : problem.residual) datum += normal(generator);
  Weighing weighing = weighed_with_late(problem);
  WeighedGroup& group = weighing.weighed.groups[0];
  group.members = {late, spring};
  group.least = group.probability;
  group.shares = {1, 0};
  group.amplitudes = {strong, 0.9 * strong};
  group.by_runs = {true, true};
  SearchSettings settings;
  settings.confirmed = 1;
  const ResidualAt linear = linear_residual(problem);
  std::vector<double> run;  // of the spring
  const ResidualAt runs = [&](const MatrixXd& amplitudes) {
    for (Index k = 0; k < amplitudes.cols(); ++k)
      if (amplitudes(static_cast<Index>(spring), k) != 0) run.push_back(amplitudes(static_cast<Index>(spring), k));
    return linear(amplitudes);
  };
  for (const bool as_good : {false, true}) {
    group.as_good = {false, as_good};
    run.clear();
    const SearchResult result = search_effects(problem, settings, runs, weighing, {});
    EXPECT_TRUE(effect_of(result, late).accepted);
    EXPECT_EQ(run, as_good ? std::vector{0.9 * strong} : std::vector<double>{});
    EXPECT_EQ(effect_of(result, spring).rival, as_good);
    EXPECT_EQ(result.verdict, as_good ? Verdict::ambiguous : Verdict::missing);
    EXPECT_EQ(effect_of(result, spring).group, effect_of(result, late).group);
  }
  group.amplitudes[1] = 0;
  const SearchResult without = search_effects(problem, settings, runs, weighing, {});
  EXPECT_FALSE(effect_of(without, spring).rival) << "it would do nothing";
  EXPECT_EQ(without.verdict, Verdict::missing);
}

/// The 95 % interval of what is named, where what is hidden is as large as expected beforehand, and beside something
/// that the data hardly show in each other data set.
TEST(AmplitudeInterval, HoldsWhatIsHidden) {
  EffectProblem problem = band(true);
  problem.pattern_deviation.setConstant(1e-3);
  int told = 0;
  const double inside = share(
      [&](std::mt19937_64& generator) {
        std::normal_distribution<double> normal;
        const double size = 2 + 4 * std::uniform_real_distribution<>()(generator);
        const double beside = std::uniform_real_distribution<>(-1, 1)(generator);
        problem.residual = size * problem.changes.col(2) + 0.4 * std::max(0.0, beside) * problem.changes.col(6);
        for (double& datum : problem.residual) datum += normal(generator);
        const SearchResult result = found(problem);
        const TestedEffect& first = result.effects.front();
        if (!first.accepted || first.candidate != 2) return true;
        ++told;
        const AmplitudeInterval interval = first.intervals.front().value();
        return interval.least <= size && size <= interval.most;
      },
      100);
  EXPECT_GT(told, 90);
  EXPECT_GE(inside, 0.89) << "0.95 of 100, two standard deviations below";
  EXPECT_LE(inside, 0.99);
}

/// What is said to be detectable is named in four of five data sets, itself or what does much the same; half of it
/// hardly ever. Independent data: noise that is alike would have to be whitened.
TEST(Detectable, IsNamedInFourOfFive) {
  EffectProblem problem = band(true);
  problem.residual.setZero(problem.changes.rows());
  const std::vector<bool> all(problem.candidates.size(), false);
  constexpr double alpha = 0.05;
  const double size = detectable_sizes(problem, {}, posterior_of(problem, SetEvidence(problem, {}), all), alpha)[2];
  const auto named = [&](double times) {
    return share(
        [&](std::mt19937_64& generator) {
          std::normal_distribution<double> normal;
          EffectProblem drawn = problem;
          drawn.residual = times * size * problem.changes.col(2);
          for (double& datum : drawn.residual) datum += normal(generator);
          const SearchResult result = found(drawn);
          return std::any_of(result.effects.begin(), result.effects.end(),
                             [](const TestedEffect& e) { return e.candidate == 2 && (e.accepted || e.rival); });
        },
        100);
  };
  EXPECT_NEAR(named(1), 0.8, 0.1);
  EXPECT_LT(named(0.5), 0.1);
}

/// Two effects that the data at hand see alike, and a trace that sees the first only.
TEST(FurtherMeasurement, TellsRivalsApart) {
  EffectProblem problem = band();
  problem.residual = 3 * problem.changes.col(2);
  const Rivals rivals{VectorXd::Zero(problem.residual.size()), VectorXd::Zero(problem.residual.size()), 1, 2};
  FurtherMeasurement trace{"trace", "", MatrixXd::Zero(10, 3), VectorXd::Constant(10, 0.5), 1};
  trace.values.col(1).setConstant(2);
  FurtherMeasurement nothing = trace;
  nothing.values.setZero();
  EXPECT_NEAR(expected_difference(problem, rivals, nullptr), 0, 1e-9);
  EXPECT_NEAR(expected_difference(problem, rivals, &nothing), 0, 1e-9);
  const double old = problem.residual(problem.training)
                         .cwiseProduct(problem.precision(problem.training))
                         .dot(VectorXd(problem.residual(problem.training)));
  const double alone = 10 * 0.5 * 4;  // the first may be scaled down, at the cost of the old data
  EXPECT_NEAR(expected_difference(problem, rivals, &trace), alone - alone * alone / (alone + old), 1e-9);
  const std::vector<Split> all = splits(problem, {rivals}, {nothing, trace});
  EXPECT_EQ(all.front().measurement, "trace");

  problem.allowed = MatrixXd::Zero(problem.residual.size(), 1);  // an input that shifts the trace
  problem.allowed_deviation = VectorXd::Constant(1, 100);
  problem.allowed_runs = {{0, 1, 1.0}};
  EXPECT_LT(expected_difference(problem, rivals, &trace), 0.1) << "the input explains it as well";
}

/// Whether an effect is there at all: what it would do to the data, old and new.
TEST(FurtherMeasurement, TellsAnEffectFromNothing) {
  EffectProblem problem = band(true);
  problem.residual = 0.1 * problem.changes.col(2);
  const Rivals pair{VectorXd::Zero(problem.residual.size()), problem.residual, 1, 0, 0};
  FurtherMeasurement trace{"trace", "", MatrixXd::Zero(10, 2), VectorXd::Constant(10, 0.5), 1};
  trace.values.col(1).setConstant(2);
  const double old = VectorXd(problem.residual(problem.training)).squaredNorm();
  EXPECT_NEAR(expected_difference(problem, pair, nullptr), old, 1e-9);
  EXPECT_NEAR(expected_difference(problem, pair, &trace), old + 10 * 0.5 * 4, 1e-9);
  EXPECT_NEAR(chance_to_tell(telling), 0.807, 1e-3);
  EXPECT_NEAR(chance_to_tell(6), 0.5, 1e-9);
  EXPECT_LT(chance_to_tell(0), 1e-9);
}

TEST(HeldOutGain, OfAHalvedDistanceIsAHalf) {
  const VectorXd before = VectorXd::LinSpaced(40, 1, 2), precision = VectorXd::Ones(40);
  std::vector<int> block;
  for (int i = 0; i < 40; ++i) block.push_back(i / 4);
  const Gain gain = gain_of(precision, block, before, 0.5 * before, 40);
  EXPECT_EQ(gain.positive, 1);
  EXPECT_DOUBLE_EQ(gain.value, 0.5);
  EXPECT_NEAR(gain.lower, 0.5, 1e-12);
  EXPECT_NEAR(gain.upper, 0.5, 1e-12);
  EXPECT_NEAR(gain.before, std::sqrt(before.squaredNorm() / 40), 1e-12);
}

}  // namespace effect_search_test
}  // namespace tether
