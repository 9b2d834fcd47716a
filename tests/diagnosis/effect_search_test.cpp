/// The search for a missing effect on a linear system: a band of 4 regions times 24 places, 8 training and 4 held-out
/// moments, with noise that is alike over 3 places.
#include "diagnosis/search/effect_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "diagnosis/results/further_data.hpp"
#include "diagnosis/search/detectable.hpp"
#include "diagnosis/search/further_measurement.hpp"
#include "diagnosis/search/phase_gain.hpp"

namespace tether {
namespace effect_search_test {

using Index = Eigen::Index;

constexpr int regions = 4, in_region = 24, places = regions * in_region, moments = 12;
constexpr double correlation = 3;  // of places

double beat(int moment) {
  return 0.5 * (1 - std::cos(2 * std::numbers::pi * moment / moments));
}

/// What a unit of an effect in `region` does: it grows with the beat; `width` in places, smooth.
VectorXd response(int region, double width, const std::function<double(int)>& in_time) {
  VectorXd all(places * moments);
  for (int m = 0; m < moments; ++m)
    for (int i = 0; i < places; ++i) {
      double away = std::abs(i - (region + 0.5) * in_region);
      away = std::min(away, places - away);
      all(m * places + i) = in_time(m) * std::exp(-0.5 * away * away / (width * width));
    }
  return all;
}

/// Noise of deviation 1 with the correlation exp(-r/l) along the band, new in each moment.
VectorXd noise(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const double a = std::exp(-1 / correlation), b = std::sqrt(1 - a * a);
  VectorXd all(places * moments);
  for (int m = 0; m < moments; ++m) {
    double now = normal(generator);
    for (int i = 0; i < places; ++i) all(m * places + i) = now = i == 0 ? now : a * now + b * normal(generator);
  }
  return all;
}

void add_candidate(EffectProblem& problem, const std::string& name, const VectorXd& change, bool one_sided = true) {
  problem.candidates.push_back({name, "band", name, Candidate::Kind::effect, {problem.changes.cols()}});
  problem.amplitudes.push_back({name, name, "1", one_sided, 5.0, 0, false});
  problem.changes.conservativeResize(change.size(), problem.changes.cols() + 1);
  problem.changes.rightCols(1) = change;
}

/// Four springs and four masses; patterns of all regions and moments. naive: as if all errors were independent.
EffectProblem band(bool naive = false) {
  EffectProblem problem;
  const Index n = places * moments;
  problem.independent = VectorXd::Constant(n, naive ? 1.0 : 1 / (2 * correlation));
  problem.precision = problem.independent;
  problem.changes.resize(n, 0);
  problem.allowed.resize(n, 0);
  problem.patterns = MatrixXd::Zero(n, regions * moments);
  for (int m = 0; m < moments; ++m)
    for (int i = 0; i < places; ++i) {
      const int block = m * regions + i / in_region;
      problem.block.push_back(m * 8 + i / 12);
      problem.moment.push_back(m);
      problem.patterns(m * places + i, block) = 1;
      (m % 3 == 2 ? problem.held_out : problem.training).push_back(m * places + i);
    }
  problem.pattern_deviation = VectorXd::Constant(regions * moments, 0.25);
  for (int b = 0; b < regions * moments; ++b)
    problem.pattern_names.push_back({std::to_string(b % regions), 1.0 * (b / regions)});
  for (int r = 0; r < regions; ++r) {
    add_candidate(problem, "spring_" + std::to_string(r), response(r, 8, beat));
    add_candidate(problem, "mass_" + std::to_string(r),
                  response(r, 8, [](int m) { return std::sin(4 * std::numbers::pi * m / moments); }));
  }
  return problem;
}

SearchResult found(const EffectProblem& problem, const SearchSettings& settings = {}) {
  return search_effects(problem, settings, linear_residual(problem));
}

/// The effect of a candidate, which must have been tested.
TestedEffect effect_of(const SearchResult& result, std::size_t candidate) {
  for (const TestedEffect& effect : result.effects)
    if (effect.candidate == candidate) return effect;
  throw std::logic_error("the candidate was not tested");
}

double share(const std::function<bool(std::mt19937_64&)>& happens, int trials = 200) {
  int count = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(1000 + trial));
    count += happens(generator) ? 1 : 0;
  }
  return static_cast<double>(count) / trials;
}

TEST(EffectSearch, RarelyFindsWhatIsNotThere) {
  const EffectProblem right = band(), naive = band(true);
  const auto alarm = [](EffectProblem problem, std::mt19937_64& generator) {
    problem.residual = noise(generator);
    return found(problem).verdict != Verdict::nothing_missing;
  };
  EXPECT_LE(share([&](auto& g) { return alarm(right, g); }), 0.10);
  EXPECT_GE(share([&](auto& g) { return alarm(naive, g); }), 0.80) << "errors that are taken for independent";
}

/// At ten standard deviations. At five, four held-out moments confirm it in half of all cases.
TEST(EffectSearch, FindsTheHiddenEffectFirst) {
  int within = 0;
  std::map<std::string, int> said;
  const double right = share([&](std::mt19937_64& generator) {
    EffectProblem problem = band();
    problem.residual = noise(generator) + 4 * problem.changes.col(4);
    const SearchResult result = found(problem);
    const TestedEffect& first = result.effects.front();
    within += std::abs(first.amplitudes(0) - 4) < 1.96 * first.deviations(0) ? 1 : 0;
    said[word_of(result.verdict) +
         (result.path.empty() ? "" : std::string(": ") + reason_of(result.path.back().objection))] += 1;
    return result.verdict == Verdict::missing && first.accepted && first.candidate == 4;
  });
  EXPECT_GE(right, 0.90) << ::testing::PrintToString(said);
  EXPECT_GE(within / 200.0, 0.90) << "the 95 % interval";
}

TEST(EffectSearch, AWrongSignIsNoSign) {
  std::mt19937_64 generator(7);
  EffectProblem problem = band();
  problem.residual = noise(generator) - 3 * problem.changes.col(2);
  const TestedEffect effect = effect_of(found(problem), 2);
  EXPECT_DOUBLE_EQ(effect.p, 1);
  EXPECT_FALSE(effect.accepted);
  EXPECT_LT(effect.z, -5);
}

/// A support that the model has, one of another shape beside it, and either in a part of its place.
TEST(EffectSearch, ShapesAndPartsOfOneEffectAreVariants) {
  Candidate support{"solid.support.regions.spine.damping", "", "", Candidate::Kind::input, {}};
  support.type = "visco_elastic", support.part = "spine", support.number = "damping";
  Candidate shape{"normal_visco_elastic", "spine", "", Candidate::Kind::effect, {}};
  shape.type = shape.name, shape.part = "spine", shape.number = "damping", shape.variant_of = "visco_elastic";
  EXPECT_TRUE(is_variant(support, shape));
  Candidate half = support;
  half.band = {0.5, 1};
  EXPECT_TRUE(is_variant(half, support));
  EXPECT_FALSE(is_variant(half, shape)) << "neither the same shape nor the same place";
  Candidate elsewhere = shape, stiffness = shape;
  elsewhere.part = "opposite", stiffness.number = "stiffness";
  EXPECT_FALSE(is_variant(support, elsewhere));
  EXPECT_FALSE(is_variant(support, stiffness));
}

TEST(EffectSearch, AVariantOfTheSameEffectIsNoOtherVerdict) {
  EffectProblem problem = band();
  add_candidate(problem, "normal_spring_1", response(1, 8.5, beat));
  problem.candidates.back().where = problem.candidates[2].where;
  problem.candidates.back().variant_of = problem.candidates[2].name;
  const double right = share(
      [&](std::mt19937_64& generator) {
        problem.residual = noise(generator) + 4 * problem.changes.col(2);
        const SearchResult result = found(problem);
        return result.verdict == Verdict::missing &&
               (result.effects[1].rival || result.effects[1].gain < result.effects[0].gain);
      },
      50);
  EXPECT_GE(right, 0.90);
}

TEST(EffectSearch, TellsWhatItCannotTellApart) {
  EffectProblem problem = band();
  add_candidate(problem, "other_spring", response(1, 8.5, beat));
  const double right = share(
      [&](std::mt19937_64& generator) {
        problem.residual = noise(generator) + 4 * problem.changes.col(2);
        const SearchResult result = found(problem);
        const auto group_of = [&](std::size_t candidate) {
          for (const TestedEffect& effect : result.effects)
            if (effect.candidate == candidate) return effect.group;
          return -1;
        };
        return result.verdict == Verdict::ambiguous && group_of(2) == group_of(8) && group_of(2) >= 0;
      },
      50);
  EXPECT_GE(right, 0.90);

  const SearchResult result = found(problem);
  const auto& effects = result.effects;
  ASSERT_EQ(result.cosines.rows(), 9);
  for (Index i = 0; i < 9; ++i) {
    EXPECT_NEAR(result.cosines(i, i), 1, 1e-12);
    for (Index j = 0; j < i; ++j) {
      EXPECT_NEAR(result.cosines(i, j), result.cosines(j, i), 1e-12);
      const std::size_t a = effects[static_cast<std::size_t>(i)].candidate,
                        b = effects[static_cast<std::size_t>(j)].candidate;
      EXPECT_EQ(result.cosines(i, j) > 0.9, std::min(a, b) == 2 && std::max(a, b) == 8) << a << " and " << b;
    }
  }
}

TEST(EffectSearch, KnowsThatTheCatalogueLacksSomething) {
  EffectProblem problem = band();
  const VectorXd stranger = response(1, 5, [](int m) { return m == 3 || m == 4 ? 1 : m == 9 || m == 10 ? -1 : 0; });
  const double right = share(
      [&](std::mt19937_64& generator) {
        problem.residual = noise(generator) + 5 * stranger;
        return found(problem).verdict == Verdict::not_in_catalogue;
      },
      50);
  EXPECT_GE(right, 0.90);
}

TEST(EffectSearch, DoesNotDecideWhatTheDataCannotShow) {
  EffectProblem problem = band();
  std::mt19937_64 generator(3);
  problem.residual = noise(generator);
  for (Amplitude& amplitude : problem.amplitudes) amplitude.scale = 0.01;
  EXPECT_EQ(found(problem).verdict, Verdict::undecided);
}

/// Errors 1.3 times as large as stated, everywhere or in the held-out data only: no candidate does that.
TEST(EffectSearch, DoubtsWhatChanceDoesNotExplain) {
  const auto undecided = [](bool everywhere, double factor) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = band();
          problem.residual = noise(generator);
          if (everywhere)
            problem.residual *= factor;
          else
            problem.residual(problem.held_out) *= factor;
          const SearchResult result = found(problem);
          return result.verdict == Verdict::undecided && result.doubtful;
        },
        100);
  };
  EXPECT_GT(undecided(true, 1.3), 0.7);
  EXPECT_GT(undecided(false, 1.6), 0.7);
  EXPECT_LT(undecided(true, 1), 0.1);
}

TEST(EffectSearch, HeldOutDataDecide) {
  std::mt19937_64 generator(5);
  EffectProblem problem = band();
  problem.residual = noise(generator);
  for (const Index i : problem.training) problem.residual(i) += 2 * problem.changes(i, 0);
  const SearchResult result = found(problem);
  ASSERT_EQ(result.path.size(), 1U);
  EXPECT_FALSE(result.path[0].accepted());
  EXPECT_EQ(result.path[0].objection, Objection::not_confirmed);
}

/// One that follows the noise of the training data fits them best, and fails on the others: all data weigh candidates.
TEST(EffectSearch, DoesNotFollowTheNoiseOfTrainingData) {
  std::mt19937_64 generator(23);
  EffectProblem problem = band();
  const VectorXd errors = noise(generator);
  problem.residual = errors + 4 * problem.changes.col(2);
  VectorXd follows = -problem.changes.col(2);
  follows(problem.training) = (problem.changes.col(2) + 0.005 * errors)(problem.training);
  add_candidate(problem, "follows_noise", follows);
  const SearchResult result = found(problem);
  ASSERT_EQ(result.path.size(), 1U);
  EXPECT_EQ(result.effects.front().candidate, 2U);
  EXPECT_TRUE(result.effects.front().accepted);
  EXPECT_EQ(result.verdict, Verdict::missing);
}

/// To first order an input that may be anything does nearly what the effect does; at the size of the truth it does not.
TEST(EffectSearch, SeesByRunsOfItsSizeWhatFirstOrderCannotJudge) {
  std::mt19937_64 generator(29);
  EffectProblem problem = band();
  const VectorXd bend = response(1, 8, [](int m) { return std::sin(2 * std::numbers::pi * m / moments); });
  problem.allowed = problem.changes.col(2) + 0.1 * bend;
  problem.allowed_deviation = VectorXd::Constant(1, infinite);
  const VectorXd spring = problem.changes.col(2);
  const auto change = [&](double a) -> VectorXd { return a * spring + a * a / 5 * bend; };
  constexpr double step = 4;
  problem.changes.col(2) = change(step) / step;
  problem.amplitudes[2].step = step;
  problem.residual = noise(generator) + change(5);
  const ResidualAt runs = [&](const MatrixXd& amplitudes) {
    MatrixXd all = linear_residual(problem)(amplitudes);
    for (Index k = 0; k < all.cols(); ++k)
      all.col(k) += amplitudes(2, k) * problem.changes.col(2) - change(amplitudes(2, k));
    return all;
  };
  const SearchResult result = search_effects(problem, {}, runs);
  ASSERT_EQ(result.verdict, Verdict::missing);
  EXPECT_EQ(result.effects.front().candidate, 2U);
  EXPECT_NEAR(result.effects.front().amplitudes(0), 5, 3 * result.effects.front().deviations(0));
}

/// An effect that saturates: runs find its amplitude where first order is far off.
TEST(EffectSearch, FindsAnAmplitudeThatSaturates) {
  std::mt19937_64 generator(11);
  EffectProblem problem = band();
  const ResidualAt runs = [&](const MatrixXd& amplitudes) -> MatrixXd {
    const MatrixXd saturated = amplitudes.array() / (1 + amplitudes.array().abs() / 6);
    return (-problem.changes * saturated).colwise() + problem.residual;
  };
  problem.residual = noise(generator) + problem.changes.col(0) * (12 / (1 + 12 / 6.0));
  const SearchResult result = search_effects(problem, {}, runs);
  ASSERT_EQ(result.verdict, Verdict::missing);
  EXPECT_EQ(result.effects.front().candidate, 0U);
  EXPECT_NEAR(result.effects.front().amplitudes(0) / 12, 1, 3 * result.effects.front().deviations(0) / 12);
  EXPECT_GT(result.effects.front().amplitudes(0), 6) << "first order says 4";
}

/// What imitates another effect only where it is larger than it may be is not named, whatever it explains.
TEST(EffectSearch, DoesNotNameWhatWouldHaveToBeLargerThanItMayBe) {
  std::mt19937_64 generator(29);
  EffectProblem problem = band();
  problem.residual = noise(generator) + 6 * problem.changes.col(4);
  ASSERT_EQ(found(problem).verdict, Verdict::missing);
  problem.amplitudes[4].upper = 2;
  const SearchResult result = found(problem);
  EXPECT_EQ(result.verdict, Verdict::not_in_catalogue);
  EXPECT_EQ(result.path.front().objection, Objection::beyond_its_limit);
  EXPECT_TRUE(result.effects.front().at_limit);
  EXPECT_NEAR(result.effects.front().amplitudes(0), 0.99 * 2, 1e-9);
}

/// The amplitude of the first, found alone, has taken in some of the second: both are refitted.
TEST(EffectSearch, RefitsWhatWasAcceptedBefore) {
  EffectProblem problem = band();
  add_candidate(problem, "late", response(2, 12, [](int m) { return m > 7 ? 1.0 : 0.0; }));
  int within = 0;
  const double both = share(
      [&](std::mt19937_64& generator) {
        problem.residual = noise(generator) + 8 * problem.changes.col(4) + 8 * problem.changes.col(8);
        const SearchResult result = found(problem);
        within += std::abs(result.amplitudes(4) - 8) < 3 ? 1 : 0;
        return result.verdict == Verdict::missing && result.path.size() == 2 && result.effects[1].accepted;
      },
      50);
  EXPECT_GE(both, 0.80);
  EXPECT_GE(within, 40);
}

/// A strong spring in region 0 and one in region 2 that hardly shows: what is left beside the first passes for noise in
/// the patterns of the whole.
TEST(EffectSearch, SeesASecondThatTheLackOfFitDoesNotShow) {
  const EffectProblem given = band();
  const auto counts = [&](bool hidden) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = given;
          problem.residual = noise(generator) + 12 * problem.changes.col(0);
          if (hidden) problem.residual += 2.2 * problem.changes.col(4);
          const SearchResult result = found(problem);
          return result.path.size() == 2 && result.path.back().accepted();
        },
        100);
  };
  EXPECT_GT(counts(true), 0.6);
  EXPECT_LE(counts(false), 0.02);
}

/// As explain looks again beside an effect that was identified.
TEST(EffectSearch, StillTestsWhereEnoughIsExplained) {
  EffectProblem problem = band();
  const auto finds = [&](double amplitude) {
    return share(
        [&](std::mt19937_64& generator) {
          problem.residual = noise(generator) + amplitude * problem.changes.col(4);
          SearchSettings settings;
          settings.enough = infinite;
          return found(problem, settings).verdict == Verdict::missing;
        },
        100);
  };
  EXPECT_GT(finds(3), 0.6);
  EXPECT_LE(finds(0), 0.02);
}

TEST(EffectSearch, SaysThatMoreIsWantedIfItMayAddOneOnly) {
  std::mt19937_64 generator(13);
  EffectProblem problem = band();
  problem.residual = noise(generator) + 5 * problem.changes.col(0) + 5 * problem.changes.col(6);
  SearchSettings settings;
  settings.most = 1;
  const SearchResult one = found(problem, settings);
  EXPECT_NE(one.verdict, Verdict::not_in_catalogue);
  EXPECT_TRUE(one.more);
  EXPECT_FALSE(found(problem).more);
}

/// Each moment from all others: what is there foretells, what noise looks like does not.
TEST(EffectSearch, WhatIsThereForetellsEachMoment) {
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
  EXPECT_LE(share([&](auto& g) { return gain(0, g).positive > 0.95; }, 100), 0.05);
  problem.moment.assign(problem.moment.size(), 0);
  EXPECT_FALSE(phase_gain(problem, {}, {2}, {}).has_value()) << "no other moment says anything";
}

/// What is said to be detectable is named in four of five data sets, in its group; with half of it hardly ever. Blocks
/// of independent places: noise that is alike would have to be whitened.
TEST(EffectSearch, NamesWhatIsDetectableInFourOfFive) {
  EffectProblem problem = band(true);
  problem.residual.setZero(problem.changes.rows());
  const std::vector<bool> all(problem.candidates.size(), false);
  const SetEvidence evidence(problem, {});
  const double size = detectable_sizes(problem, evidence, posterior_of(problem, evidence, all))[2];
  const auto named = [&](double times) {
    return share([&](std::mt19937_64& generator) {
      std::normal_distribution<double> normal;
      EffectProblem drawn = problem;
      drawn.residual = times * size * problem.changes.col(2);
      for (double& datum : drawn.residual) datum += normal(generator);
      const SetEvidence told(drawn, {});
      return posterior_of(drawn, told, all).of(2) > 0.95;
    });
  };
  EXPECT_NEAR(named(1), 0.8, 0.1);
  EXPECT_LT(named(0.5), 0.1);
}

/// What only a hundred times its size would show is improbable, however well it fits, and not out of the question.
TEST(EffectSearch, AnImprobableSizeMakesAnImprobableEffect) {
  std::mt19937_64 generator(17);
  EffectProblem problem = band();
  add_candidate(problem, "tiny", 0.01 * problem.changes.col(2));
  problem.residual = noise(generator) + 4 * problem.changes.col(2);
  const SearchResult result = found(problem);
  const TestedEffect effect = effect_of(result, 8);
  ASSERT_EQ(result.weighed.groups.front().members, (std::vector<std::size_t>{2, 8}));
  EXPECT_LT(result.weighed.groups.front().shares[1], 0.1);
  EXPECT_FALSE(effect.testable);
  EXPECT_FALSE(effect.accepted);
}

TEST(EffectSearch, RunsNothingThatIsHopeless) {
  std::mt19937_64 generator(19);
  EffectProblem problem = band();
  problem.residual = noise(generator) + 5 * problem.changes.col(2);
  int runs = 0;
  const ResidualAt counted = [&](const MatrixXd& amplitudes) {
    runs += static_cast<int>(amplitudes.cols());
    EXPECT_EQ(amplitudes.row(6).norm(), 0) << "far from it";
    return linear_residual(problem)(amplitudes);
  };
  EXPECT_EQ(search_effects(problem, {}, counted).verdict, Verdict::missing);
  EXPECT_LE(runs, 4);
}

/// What does to first order the same as the right one, and saturates: runs show it, few of them.
TEST(EffectSearch, RunsLookAlikesBeforeItChooses) {
  std::mt19937_64 generator(23);
  EffectProblem problem = band();
  add_candidate(problem, "weak", response(1, 8.5, beat));
  add_candidate(problem, "weak_too", response(1, 8.6, beat));
  problem.residual = noise(generator) + 5 * problem.changes.col(2);
  int first = 0, second = 0;
  const ResidualAt counted = [&](const MatrixXd& amplitudes) -> MatrixXd {
    MatrixXd saturated = amplitudes;
    for (const Index k : {8, 9}) saturated.row(k) = amplitudes.row(k).array() / (1 + amplitudes.row(k).array().abs());
    first += static_cast<int>((amplitudes.row(8).array() != 0).count());
    second += static_cast<int>((amplitudes.row(9).array() != 0).count());
    return linear_residual(problem)(saturated);
  };
  EXPECT_EQ(search_effects(problem, {}, counted).effects.front().candidate, 2U);
  EXPECT_GE(std::min(first, second), 1);
  EXPECT_LE(first + second, 4);
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
