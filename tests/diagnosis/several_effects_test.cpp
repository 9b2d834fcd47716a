/// The search where more than one effect is missing, on a linear system.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "diagnosis/search/effect_search.hpp"
#include "tests/diagnosis/band.hpp"

namespace tether {
namespace effect_search_test {

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

/// By itself it would have to be negative, as a coarse mesh beside a hidden spring: what is accepted after it was tried
/// makes it asked for again.
TEST(EffectSearch, AsksAgainForWhatRemovesNothingByItself) {
  const double finds = share(
      [](std::mt19937_64& generator) {
        EffectProblem problem = band();
        problem.changes.col(4) -= 0.6 * problem.changes.col(0);
        problem.residual = noise(generator) + 9 * problem.changes.col(0) + 5 * problem.changes.col(4);
        const auto residual_at = linear_residual(problem);
        Weighing weighing = weighed_fully(problem, {}, residual_at);
        std::stable_partition(weighing.weighed.groups.begin(), weighing.weighed.groups.end(),
                              [](const WeighedGroup& group) { return group.has(4); });
        for (const ShownRun& run : search_effects(problem, {}, residual_at, weighing).runs)
          weighing.shown.push_back(run);  // so that nothing is weighed again, in another order
        const SearchResult result = search_effects(problem, {}, residual_at, weighing);
        return effect_of(result, 0).accepted && effect_of(result, 4).accepted;
      },
      20);
  EXPECT_GT(finds, 0.9);
}

/// The first effect saturates, and stays beside its best size with one run; beside a second one, which does nothing, it
/// comes there.
TEST(EffectSearch, WhatTheFirstGainsBesideASecondIsNoReasonToNameThat) {
  std::mt19937_64 generator(37);
  EffectProblem problem = band();
  const auto saturating = [](double a) { return a / (1 + a / 12); };
  const VectorXd errors = noise(generator);
  problem.residual = errors + saturating(12) * problem.changes.col(0);
  const ResidualAt runs = [&](const MatrixXd& amplitudes) {
    MatrixXd all(problem.residual.size(), amplitudes.cols());
    for (Index k = 0; k < all.cols(); ++k)
      all.col(k) = problem.residual - saturating(amplitudes(0, k)) * problem.changes.col(0);
    return all;
  };
  SearchSettings settings;
  settings.refinements = 1;
  Weighing weighing = weighed_fully(problem, settings, runs);
  ASSERT_TRUE(weighing.weighed.groups.front().has(0));
  weighing.weighed.groups.front().amplitudes.front() = 6;  // by another run of it
  weighing.weighed.groups.push_back({1, 1, {6}, {1.0}, {0.1}, {true}, {}, {}});
  for (const ShownRun& run : search_effects(problem, settings, runs, weighing).runs) weighing.shown.push_back(run);
  const SearchResult result = search_effects(problem, settings, runs, weighing);
  ASSERT_TRUE(effect_of(result, 0).accepted);
  EXPECT_FALSE(effect_of(result, 6).accepted);
  EXPECT_EQ(result.path.back().candidate, 6U);
  EXPECT_EQ(result.path.back().objection, Objection::too_weak);
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

/// Beside the first effect the second does nothing at a third of the places where it does by itself: the sum of what
/// each does alone is right with another candidate, which is none by runs of both.
TEST(EffectSearch, RunsOfBothDecideWhatTheSumOfBothDoesNotTell) {
  std::mt19937_64 generator(31);
  EffectProblem problem = band();
  const auto two_thirds = [&](const VectorXd& whole) {
    VectorXd part = whole;
    for (Index i = 0, seen = 0; i < part.size(); ++i)
      if (part(i) != 0 && seen++ % 3 == 0) part(i) = 0;
    return part;
  };
  const VectorXd second = problem.changes.col(2), part = two_thirds(second);
  add_candidate(problem, "part", part);
  problem.residual = noise(generator) + 12 * problem.changes.col(6) + 8 * part;
  const ResidualAt runs = [&](const MatrixXd& amplitudes) {
    MatrixXd all = linear_residual(problem)(amplitudes);
    for (Index k = 0; k < all.cols(); ++k)
      if (amplitudes(6, k) != 0) all.col(k) += amplitudes(2, k) * (second - part) + amplitudes(8, k) * part;
    return all;
  };
  const SearchResult result = search_effects(problem, {}, runs);
  const auto has_part = std::find_if(result.weighed.groups.begin(), result.weighed.groups.end(),
                                     [](const WeighedGroup& one) { return one.has(8); });
  ASSERT_NE(has_part, result.weighed.groups.end());
  EXPECT_GT(has_part->probability, 0.95) << "by the sum of what each does alone";
  EXPECT_TRUE(effect_of(result, 6).accepted);
  EXPECT_TRUE(effect_of(result, 2).accepted);
  EXPECT_FALSE(effect_of(result, 8).accepted);
  EXPECT_FALSE(effect_of(result, 8).rival);
  EXPECT_NEAR(effect_of(result, 2).amplitudes(0), 8, 1.5);
}

/// A look-alike that does something else by itself, and the same beside a second effect: runs of both decide.
TEST(EffectSearch, RunsOfBothDecideBesideWhatIsAccepted) {
  std::mt19937_64 generator(31);
  EffectProblem problem = band();
  add_candidate(problem, "other", problem.changes.col(2));
  problem.residual = noise(generator) + 8 * problem.changes.col(6) + 5 * problem.changes.col(2);
  const VectorXd bend = 0.35 * response(1, 3, beat);
  const ResidualAt runs = [&](const MatrixXd& amplitudes) {
    MatrixXd all = linear_residual(problem)(amplitudes);
    for (Index k = 0; k < all.cols(); ++k)
      if (amplitudes(6, k) == 0) all.col(k) += amplitudes(8, k) * bend;
    return all;
  };
  const SearchResult result = search_effects(problem, {}, runs);
  const WeighedGroup& group = *std::find_if(result.weighed.groups.begin(), result.weighed.groups.end(),
                                            [](const WeighedGroup& one) { return one.has(2); });
  ASSERT_EQ(group.members.size(), 2U);
  EXPECT_GE(group.shares[1], 0.1) << "by runs of both, though by what each does alone it is one of them";
  EXPECT_TRUE(effect_of(result, 2).accepted);
  EXPECT_TRUE(effect_of(result, 6).accepted);
  EXPECT_TRUE(effect_of(result, 8).rival);
  EXPECT_EQ(result.verdict, Verdict::ambiguous);
}

WeighedGroup of_one(std::size_t candidate, double amplitude) {
  return {1, 1, {candidate}, {1.0}, {amplitude}, {true}, {}, {}};
}

/// Found where the table has these groups; `more` was run too.
SearchResult found_with(const EffectProblem& problem, std::vector<WeighedGroup> groups,
                        const std::vector<ShownRun>& more, const ResidualAt& residual_at) {
  Weighing weighing = weighed_fully(problem, {}, residual_at);
  weighing.weighed.groups = std::move(groups);
  for (const ShownRun& run : search_effects(problem, {}, residual_at, weighing).runs)
    weighing.shown.push_back(run);  // so that nothing is weighed again
  weighing.shown.insert(weighing.shown.end(), more.begin(), more.end());
  return search_effects(problem, {}, residual_at, weighing);
}

SearchResult found_with(const EffectProblem& problem, std::vector<WeighedGroup> groups,
                        const std::vector<ShownRun>& more = {}) {
  return found_with(problem, std::move(groups), more, linear_residual(problem));
}

/// A candidate at `size`, and what it does there on a finer mesh per unit.
std::vector<ShownRun> shown_on_finer(const EffectProblem& problem, Index candidate, double size,
                                     const VectorXd& finer) {
  const VectorXd amplitudes = size * VectorXd::Unit(problem.changes.cols(), candidate);
  return {{amplitudes, problem.residual - size * problem.changes.col(candidate), RunOf::model},
          {amplitudes, problem.residual - size * finer, RunOf::finer}};
}

/// What runs of both say explains more than what is named beside the first is a rival of that, whatever the table has.
TEST(EffectSearch, WhatExplainsMoreThanWhatIsNamedBesideAnotherIsItsRival) {
  const auto rivals = [](Index hidden) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = band();
          add_candidate(problem, "other", response(2, 11, beat));
          problem.residual = noise(generator) + 9 * problem.changes.col(0) + 3.5 * problem.changes.col(hidden);
          const SearchResult result = found_with(problem, {of_one(0, 9), of_one(4, 3.5)});
          return effect_of(result, 4).accepted && effect_of(result, 8).rival && result.verdict == Verdict::ambiguous;
        },
        20);
  };
  EXPECT_GT(rivals(8), 0.8);
  EXPECT_LT(rivals(4), 0.2) << "explains less, as a rule";
}

/// What another mesh changes in what is named tells how wrong a law may be that looks like it: no lead within that
/// decides.
TEST(EffectSearch, ALeadThatAnotherMeshMayMakeDecidesNothingBesideAnother) {
  const auto rivals = [](bool on_another_mesh) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = band();
          constexpr double size = 6, reach = 0.6;  // of the way that a mesh twice as fine goes
          const VectorXd own = problem.changes.col(4);
          add_candidate(problem, "other", own + 1.4 * response(2, 3, beat));
          problem.residual = noise(generator) + 9 * problem.changes.col(0) + size * own;
          std::vector<ShownRun> more;
          if (on_another_mesh) more = shown_on_finer(problem, 4, size, own - reach * 0.5 * response(2, 4, beat));
          const SearchResult result =
              found_with(problem, {of_one(0, 9), {1, 1, {4, 8}, {0.9, 0.1}, {size, size}, {true, true}, {}, {}}}, more);
          return effect_of(result, 4).accepted && effect_of(result, 8).rival;
        },
        20);
  };
  EXPECT_GT(rivals(true), 0.8);
  EXPECT_LT(rivals(false), 0.2);
}

/// What promises much and explains little, once it is run, is no rival, however wrong another mesh makes it.
TEST(EffectSearch, WhatExplainsLittleIsNoRivalHoweverWrongItsMesh) {
  const double rivals = share(
      [](std::mt19937_64& generator) {
        EffectProblem problem = band();
        constexpr double size = 6;
        const VectorXd promised = problem.changes.col(4) + 0.3 * response(2, 3, beat),
                       does = 0.14 * problem.changes.col(6);
        add_candidate(problem, "idle", promised);
        problem.residual = noise(generator) + 9 * problem.changes.col(0) + size * problem.changes.col(4) + size * does;
        const ResidualAt runs = [&](const MatrixXd& amplitudes) -> MatrixXd {
          return linear_residual(problem)(amplitudes) + (promised - does) * amplitudes.row(8);
        };
        std::vector<ShownRun> more = shown_on_finer(problem, 8, size, does + problem.changes.col(7));
        more.front().residual = problem.residual - size * does;
        for (const ShownRun& run : shown_on_finer(problem, 0, 9, 1.01 * problem.changes.col(0))) more.push_back(run);
        const SearchResult result = found_with(
            problem, {of_one(0, 9), {1, 1, {4, 8}, {0.9, 0.1}, {size, size}, {true, true}, {}, {}}}, more, runs);
        return effect_of(result, 4).accepted && effect_of(result, 8).rival;
      },
      20);
  EXPECT_LT(rivals, 0.2);
}

/// The table adds up what each of two look-alikes does, and has both; runs find nothing for the second beside the
/// first, and as much as the first in its place.
TEST(EffectSearch, WhatIsTooWeakBesideAnotherMayStandInItsPlace) {
  const auto rivals = [](const VectorXd& other) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = band();
          add_candidate(problem, "other", other);
          problem.residual = noise(generator) + 4 * problem.changes.col(0);
          const SearchResult result = found_with(problem, {of_one(0, 4), of_one(8, 4)});
          return effect_of(result, 0).accepted && !effect_of(result, 8).accepted && effect_of(result, 8).rival;
        },
        20);
  };
  const EffectProblem given = band();
  EXPECT_GT(rivals(0.97 * given.changes.col(0) + 0.15 * given.changes.col(1)), 0.8);
  EXPECT_LT(rivals(given.changes.col(3)), 0.1) << "acts elsewhere";
}

/// What a group does beside the first is there in the training moments alone: held-out ones do not confirm it. One of
/// it does in the place of the first.
TEST(EffectSearch, WhatIsNotConfirmedBesideAnotherMayStandInItsPlace) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::mt19937_64 generator(seed);
    EffectProblem problem = band();
    const VectorXd in_training = response(1, 8, [](int m) { return m % 3 == 2 ? 0.0 : beat(m); });
    add_candidate(problem, "other", problem.changes.col(0) + 0.6 * in_training);
    problem.residual = noise(generator) + 6 * problem.changes.col(0) + 3 * in_training;
    const SearchResult result =
        found_with(problem, {of_one(0, 6), {1, 1, {2, 8}, {0.9, 0.1}, {3, 6}, {true, true}, {}, {}}});
    ASSERT_TRUE(effect_of(result, 0).accepted);
    ASSERT_EQ(result.path.at(1).candidate, 2U);
    ASSERT_EQ(result.path.at(1).objection, Objection::not_confirmed);
    EXPECT_TRUE(effect_of(result, 8).rival);
    EXPECT_NEAR(effect_of(result, 8).amplitudes(0), 6, 1.5);
  }
}

/// The first law's place is taken by a look-alike, which leaves a part of it that a third one explains.
TEST(EffectSearch, TwoThatOneLawDoesTheWorkOfAreThatLaw) {
  const auto joins = [](double more, const std::string& where) {
    return share(
        [&](std::mt19937_64& generator) {
          EffectProblem problem = band();
          add_candidate(problem, "wide", response(2, 16, beat));
          const VectorXd both = problem.changes.col(4) + problem.changes.col(8);
          add_candidate(problem, "law", 0.7 * both + more * problem.changes.col(5));
          problem.candidates[8].part = where;
          problem.residual = noise(generator) + 9 * problem.changes.col(0) + 7 * both;
          const SearchResult result = found_with(
              problem, {{1, 1, {4, 9}, {0.9, 0.1}, {12, 10}, {true, true}, {}, {}}, of_one(0, 9), of_one(8, 7)});
          EXPECT_TRUE(effect_of(result, 0).accepted);
          const bool is_law = effect_of(result, 9).accepted;
          EXPECT_EQ(effect_of(result, 4).accepted, !is_law);
          EXPECT_EQ(effect_of(result, 8).accepted, !is_law);
          EXPECT_EQ(result.path.front().objection == Objection::part_of_one_law, is_law);
          if (is_law) {
            EXPECT_NEAR(effect_of(result, 9).amplitudes(0), 10, 2);
            EXPECT_EQ(effect_of(result, 0).amplitudes.size(), 1);
            EXPECT_FALSE(effect_of(result, 4).rival || effect_of(result, 8).rival);
          }
          return is_law;
        },
        10);
  };
  EXPECT_EQ(joins(0, ""), 1);
  EXPECT_LT(joins(0.6, ""), 0.1) << "it does more than both, that is not there";
  EXPECT_EQ(joins(0, "elsewhere"), 0);
}

/// Beside what it is a rival of, it has nothing to do: its size is that in the place of it.
TEST(EffectSearch, ARivalsSizeIsThatInThePlaceOfWhatWasAccepted) {
  std::mt19937_64 generator(31);
  EffectProblem problem = band();
  add_candidate(problem, "other", 1.02 * problem.changes.col(0));
  problem.residual = noise(generator) + 9 * problem.changes.col(0) + 6 * problem.changes.col(4);
  const SearchResult result = found_with(problem, {{1, 1, {0, 8}, {0.6, 0.4}, {9, 9}, {true, true}, {}, {}},
                                                   {1, 1, {4, 8}, {0.9, 0.1}, {6, 1}, {true, true}, {}, {}}});
  ASSERT_TRUE(effect_of(result, 0).accepted);
  ASSERT_TRUE(effect_of(result, 4).accepted);
  ASSERT_TRUE(effect_of(result, 8).rival);
  EXPECT_NEAR(effect_of(result, 8).amplitudes(0), 9, 2);
  EXPECT_GT(effect_of(result, 8).confirmed_gain, 100);
}

/// Beside the first effect the table asks for a second one, which is refused; what explains less is no stand-in for it.
TEST(EffectSearch, TakesNothingInPlaceOfWhatIsRefusedUnlessItExplainsMore) {
  std::mt19937_64 generator(31);
  EffectProblem problem = band();
  add_candidate(problem, "other", 0.75 * problem.changes.col(2) + 0.7 * problem.changes.col(1));
  problem.residual =
      noise(generator) + 12 * problem.changes.col(6) + 2.4 * problem.changes.col(2) + 0.6 * problem.changes.col(1);
  const SearchResult free = found(problem);
  ASSERT_TRUE(effect_of(free, 2).accepted);
  EXPECT_FALSE(effect_of(free, 8).rival);
  EXPECT_EQ(free.verdict, Verdict::missing);
  problem.amplitudes[2].upper = 2;
  const SearchResult result = found(problem);
  ASSERT_EQ(result.weighed.groups.size() > 1 ? result.weighed.groups[1].members : std::vector<std::size_t>{},
            std::vector<std::size_t>{2});
  EXPECT_GT(result.weighed.groups[1].probability, 0.95);
  EXPECT_TRUE(effect_of(result, 6).accepted);
  EXPECT_FALSE(effect_of(result, 8).accepted);
  EXPECT_EQ(result.path.back().objection, Objection::beyond_its_limit);
}

}  // namespace effect_search_test
}  // namespace tether
