#pragma once

#include <string>
#include <vector>

#include "diagnosis/search/wanted_runs.hpp"

namespace tether {

struct SearchSettings {
  double alpha = 0.05;                    ///< probability of a false alarm over all candidates
  double unexplained = 0.1;               ///< if more of what the data ask for remains, something else is missing
  double enough = 0;                      ///< excess (D.11) below which another effect must stand out at alpha/5
  int most = 3;                           ///< effects that are added to the model, errors of the data aside
  int refinements = 5;                    ///< runs at most for an effect's amplitude
  int confirmed = 8;                      ///< candidates whose amplitude is found with runs, before one is chosen
  int compared = 12;                      ///< of the strongest, how much each looks like each other is kept
  std::vector<std::string> refused = {};  ///< numbers of candidates that are not accepted
};

/// Of each candidate, whether one of its numbers is refused.
std::vector<bool> refused_in(const EffectProblem& problem, const SearchSettings& settings);

/// How probable each explanation is, and the runs that told.
struct Weighing {
  Weighed weighed;
  std::vector<ShownRun> shown;
};
/// What shows what amplitudes do.
struct ShowingRuns {
  const ResidualAt& residual_at;
  RunOf of = RunOf::model;
};
/// Weighs; what matters and was not run at its size is run and weighed again. shown: runs that were made before. finer:
/// runs of a finer model, if there is one, for what the numerics change in what leads.
Weighing weigh_effects(const EffectProblem& problem, const SearchSettings& settings, const ShowingRuns& runs,
                       RunsFor purpose, std::vector<ShownRun> shown = {}, const ResidualAt& finer = {});
/// Explored and told with the same runs.
Weighing weighed_fully(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at);

}  // namespace tether
