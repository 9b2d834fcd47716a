#pragma once

#include <optional>

#include "diagnosis/effect_problem.hpp"
#include "diagnosis/held_out_gain.hpp"

namespace tether {

struct SearchSettings {
  double alpha = 0.05;       ///< probability of a false alarm over all candidates
  double unexplained = 0.3;  ///< if more of the misfit beyond noise remains, something else is missing
  int most = 3;              ///< effects that are added
  int refinements = 5;       ///< runs at most for an effect's amplitude
  int confirmed = 8;         ///< candidates whose amplitude is found with runs, before one is chosen
  int compared = 12;         ///< of the strongest, how much each looks like each other is kept
};

/// What the data say of one candidate.
struct TestedEffect {
  std::size_t candidate = 0;
  double gain = 0;                  ///< of the misfit, by its best amplitudes to first order (D.10)
  double z = 0, p = 1, q = 1;       ///< q: corrected for the number of candidates
  VectorXd amplitudes, deviations;  ///< of its own; after confirmation at finite size
  double retained = 0;              ///< share of its information that errors allowed cannot explain as well
  bool confirmed = false;           ///< the amplitudes are those of runs
  double confirmed_gain = 0;        ///< of the misfit, by those runs
  std::optional<Gain> held_out;
  bool accepted = false;
  int group = -1;      ///< effects that look alike have the same number
  double cosine = 0;   ///< with the first of the group
  double visible = 0;  ///< smallest size of its first amplitude that would be seen with 80 % probability (D.12)
};

/// How much of the misfit no noise, no allowed error and no accepted effect explains. (D.11)
struct LackOfFit {
  double p = 1;       ///< that noise alone makes the worst pattern
  double excess = 0;  ///< of the patterns' squares over what noise makes
  std::size_t worst = 0;
  double z = 0;  ///< of the worst
};

/// One attempt to add an effect.
struct SearchStep {
  std::size_t candidate = 0;
  bool accepted = false;
  std::string reason;  ///< why not
  double misfit_before = 0, misfit_after = 0;
  LackOfFit left;
};

struct SearchResult {
  std::string verdict;                ///< missing, nothing_missing, ambiguous, not_in_catalogue or undecided
  std::vector<TestedEffect> effects;  ///< accepted ones first, then by their evidence
  MatrixXd cosines;                   ///< of the changes that the first of `effects` make, each with each other
  std::vector<SearchStep> path;
  LackOfFit before, after;
  VectorXd amplitudes;     ///< of all accepted effects [q]
  VectorXd residual;       ///< with them [n]
  double independent = 0;  ///< number of independent training data
  double dispersion = 1;   ///< misfit per independent datum that is left, at least 1: intervals are widened by its root
  std::optional<Gain> held_out;
};

/// Tests every candidate, finds the amplitudes of the strongest with runs, accepts one effect at a time as long as the
/// data at hand and those held out ask for it, and judges what is left. (D.8-D.13)
SearchResult search_effects(const EffectProblem& problem, const SearchSettings& settings,
                            const ResidualAt& residual_at);

}  // namespace tether
