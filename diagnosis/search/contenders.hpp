#pragma once

#include "diagnosis/search/effect_tests.hpp"
#include "diagnosis/search/weighing.hpp"

namespace tether {

/// Beside what, and with what, a group of the table is tried.
struct Trial {
  const EffectProblem& problem;
  const SearchSettings& settings;
  const Scores& scores;  ///< beside what is accepted
  double independent;    ///< number of data
  bool is_first;         ///< nothing is accepted yet
};

/// Members of a group that may be it, at their most probable amplitudes. Beside what is accepted all of them, and all
/// that look like the first: their shares are of what each does alone, runs of both together decide.
std::vector<TestedEffect> contenders_of(const WeighedGroup& group, const Trial& trial);

}  // namespace tether
