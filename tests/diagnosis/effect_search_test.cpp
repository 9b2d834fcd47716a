/// The search for a missing effect on a linear system.
#include "diagnosis/search/effect_search.hpp"
#include "diagnosis/search/judgement.hpp"
#include "diagnosis/search/shares_by_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "tests/diagnosis/band.hpp"

namespace tether {
namespace effect_search_test {

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
  half.extent = {0.5, 1};
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

/// On another mesh the wall does not follow a spring in the middle of its place, so that the spring's own pattern
/// explains little. What the table allows for, runs are asked with too.
TEST(EffectSearch, LeavesFreeWhatAnotherMeshChangesInAnEffect) {
  EffectProblem problem = band();
  const VectorXd own = problem.changes.col(4), elsewhere = own - 1.8 * response(2, 3, beat);
  constexpr double size = 7, reach = 0.6;  // of the way that a mesh twice as fine goes
  EXPECT_LT(own.dot(elsewhere) / (own.norm() * elsewhere.norm()), 0.3);
  EXPECT_GE(share(
                [&](std::mt19937_64& generator) {
                  problem.residual = noise(generator) + size * elsewhere;
                  const VectorXd amplitudes = size * VectorXd::Unit(problem.changes.cols(), 4);
                  const ResidualAt runs = linear_residual(problem);
                  const Weighing weighing = weigh_effects(
                      problem, {}, {runs}, RunsFor::telling,
                      {{amplitudes, problem.residual - size * own, RunOf::model},
                       {amplitudes, problem.residual - size * (own + reach * (elsewhere - own)), RunOf::finer}});
                  const SearchResult result = search_effects(problem, {}, runs, weighing);
                  return result.verdict == Verdict::missing && effect_of(result, 4).accepted;
                },
                20),
            0.90);
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

/// What sums of regions show but little, and not quite rightly: their lack of fit, which chance explains, may grow.
TEST(EffectSearch, DoesNotAskOfAnEffectThatALackOfFitFallsWhichChanceExplains) {
  EffectProblem problem = band();
  VectorXd odd = response(1, 8, beat);
  for (Index i = 0; i < odd.size(); ++i)
    if (i % places < 1.5 * in_region) odd(i) = -odd(i);
  add_candidate(problem, "odd", odd + 0.15 * problem.changes.col(4));
  const double named = share(
      [&](std::mt19937_64& generator) {
        problem.residual = noise(generator) + 6 * odd;
        return effect_of(found(problem), 8).accepted;
      },
      50);
  EXPECT_GE(named, 0.95);
}

/// What explains all, and is not named since its probability is not high enough, is not outside the catalogue.
TEST(EffectSearch, IsUndecidedWhereWhatExplainsAllIsNotProbableEnough) {
  std::mt19937_64 generator(37);
  EffectProblem problem = band();
  problem.residual = noise(generator) + 8 * problem.changes.col(2);
  const ResidualAt runs = linear_residual(problem);
  const Weighing sure = weighed_fully(problem, {}, runs);
  ASSERT_EQ(search_effects(problem, {}, runs, sure).verdict, Verdict::missing);
  const auto found_with = [&](double probability, double least) {
    Weighing weighing = sure;
    weighing.weighed.groups.front().probability = probability;
    weighing.weighed.groups.front().least = least;
    return search_effects(problem, {}, runs, weighing);
  };
  for (const auto& [probability, least, objection] :
       {std::tuple{0.8, 0.8, Objection::not_sure}, {0.99, 0.2, Objection::assumed}}) {
    const SearchResult result = found_with(probability, least);
    EXPECT_EQ(result.path.front().objection, objection);
    EXPECT_EQ(result.verdict, Verdict::undecided);
    EXPECT_LT(result.after.p, 1e-3) << "what is left without it";
  }
  EXPECT_EQ(found_with(0.3, 0.3).verdict, Verdict::not_in_catalogue) << "none is as probable as not";
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

/// A law that explains most, and leaves a place farther off at a moment than noise makes, is not named for sure.
TEST(EffectSearch, ALawThatLeavesPatternsIsNotNamedForSure) {
  const auto verdicts = [](double besides, Verdict verdict) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = band();
          problem.residual = noise(generator) + 12 * problem.changes.col(2) +
                             besides * response(3, 8, [](int m) { return m == 4 ? 1.0 : 0.0; });
          const SearchResult result = found(problem);
          return effect_of(result, 2).accepted && result.verdict == verdict;
        },
        20);
  };
  EXPECT_GT(verdicts(4, Verdict::undecided), 0.8);
  EXPECT_GT(verdicts(0, Verdict::missing), 0.9) << "leaves noise";
}

/// Beside a coarse mesh nothing is missing, unless something is as probable as not, which runs do not contradict.
TEST(EffectSearch, AnErrorOfTheMeshIsNotAllWhereALawIsAsProbableAsNot) {
  int open = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 generator(seed);
    EffectProblem problem = band();
    problem.candidates[0].kind = CandidateKind::numerics;
    problem.residual = noise(generator) + 8 * problem.changes.col(0) + 1.3 * problem.changes.col(4);
    const SearchResult result = found(problem);
    const auto& groups = result.weighed.groups;
    const bool is_probable = std::any_of(groups.begin(), groups.end(), [](const WeighedGroup& group) {
      return group.has(4) && group.probability > 0.5 && group.probability < 0.95;
    });
    const bool is_refused_for_that = std::any_of(result.path.begin(), result.path.end(), [](const SearchStep& step) {
      return step.candidate == 4 && step.objection == Objection::not_sure;
    });
    if (!is_probable || !is_refused_for_that || !effect_of(result, 0).accepted) continue;
    ++open;
    EXPECT_EQ(result.verdict, Verdict::undecided) << seed;
  }
  EXPECT_GE(open, 3);
}

/// What the table adds up says one, runs of what was tried say another.
TEST(EffectSearch, SharesAreThoseOfRuns) {
  std::vector<TestedEffect> effects(4);
  EffectProblem problem;
  problem.amplitudes.resize(4);
  for (std::size_t k = 0; k < 4; ++k) {
    effects[k].candidate = k, effects[k].amplitudes = VectorXd::Constant(1, 10.0);
    problem.candidates.push_back({"c", "", "", Candidate::Kind::effect, {static_cast<Index>(k)}});
  }
  for (const std::size_t k : {0, 1, 2}) effects[k].confirmed = true;
  effects[0].accepted = true;
  effects[0].confirmed_gain = 71.6, effects[1].confirmed_gain = 71.4, effects[2].confirmed_gain = 40;
  Weighed weighed;
  WeighedGroup& group = weighed.groups.emplace_back();
  group.members = {1, 3, 0, 2};
  group.shares = {0.7, 0.2, 0.0, 0.1};
  group.amplitudes = {5, 6, 7, 8};
  group.by_runs = {false, false, false, false};
  share_by_runs(weighed, effects, problem, 1, {0, 1, 2, 3});
  EXPECT_EQ(group.members, (std::vector<std::size_t>{0, 1, 3, 2}));
  EXPECT_NEAR(group.shares[0], 0.8 / (1 + std::exp(-0.1)), 1e-6);
  EXPECT_NEAR(group.shares[0] + group.shares[1] + group.shares[3], 0.8, 1e-12) << "what they had together";
  EXPECT_EQ(group.shares[2], 0.2) << "was not tried";
  EXPECT_EQ(group.amplitudes, (std::vector<double>{10, 10, 6, 10}));
  EXPECT_EQ(group.by_runs, (std::vector<bool>{true, true, false, true}));
  effects[1].accepted = true;
  const WeighedGroup before = group;
  share_by_runs(weighed, effects, problem, 1, {0, 1, 2, 3});
  EXPECT_EQ(group.shares, before.shares) << "two that are there together";

  effects[1].accepted = false;
  group.members.pop_back(), group.shares.pop_back(), group.amplitudes.pop_back(), group.by_runs.pop_back();
  effects[2].rival = true, effects[2].confirmed_gain = 71.6;
  share_by_runs(weighed, effects, problem, 1, {0, 1, 0, 3});
  ASSERT_EQ(group.members.size(), 4U) << "a rival has a line";
  EXPECT_TRUE(group.has(2));
  EXPECT_EQ(group.shares[0], group.shares[1]) << "it removes as much";
}

/// What explains the data at hand and takes the model away from those held out is not named.
TEST(EffectSearch, NamesNothingThatHeldOutDataRefute) {
  std::mt19937_64 generator(17);
  EffectProblem problem = band();
  problem.residual = noise(generator) + 8 * problem.changes.col(0);
  const SearchResult named = found(problem);
  ASSERT_EQ(named.verdict, Verdict::missing);
  ASSERT_TRUE(named.held_out && named.held_out->lower > 0);
  problem.training.clear(), problem.held_out.clear();
  for (Index row = 0; row < problem.residual.size(); ++row) {
    const Index moment = row / places;
    (moment == 2 || moment == 10 ? problem.held_out : problem.training).push_back(row);
  }
  for (const Index row : problem.held_out) problem.residual(row) -= 12 * problem.changes(row, 0);
  const SearchResult refuted = found(problem);
  EXPECT_TRUE(effect_of(refuted, 0).accepted);
  ASSERT_TRUE(refuted.held_out.has_value());
  EXPECT_LT(refuted.held_out->upper, 0);
  EXPECT_EQ(refuted.verdict, Verdict::undecided);
}

/// A place that is farther off than any noise: what is named beside it is not known.
TEST(EffectSearch, NamesNothingBesideAPlaceThatNoNoiseLaysOff) {
  std::mt19937_64 generator(13);
  EffectProblem problem = band();
  problem.residual = noise(generator) + 8 * problem.changes.col(0);
  const SearchResult named = found(problem);
  ASSERT_EQ(named.verdict, Verdict::missing);
  ASSERT_FALSE(named.doubtful);
  LocatedMisfit place;
  for (const double z : {5.9, 6.1}) {
    place.z = z;
    SearchResult result = named;
    judge_place(place, problem, result);
    EXPECT_EQ(result.verdict, z > 6 ? Verdict::undecided : Verdict::missing);
    EXPECT_EQ(result.doubtful, z > 6);
  }
  SearchResult more = named;
  more.more = true;
  judge_place(place, problem, more);
  EXPECT_EQ(more.verdict, Verdict::missing) << "the next diagnosis may find it";
  problem.residual = noise(generator);
  SearchResult nothing = found(problem);
  ASSERT_EQ(nothing.verdict, Verdict::nothing_missing);
  judge_place(place, problem, nothing);
  EXPECT_EQ(nothing.verdict, Verdict::undecided);
  SearchResult unseen = named;
  judge_place(std::nullopt, problem, unseen);
  EXPECT_EQ(unseen.verdict, Verdict::missing);
}

}  // namespace effect_search_test
}  // namespace tether
