#pragma once

#include "diagnosis/results/adequacy.hpp"
#include "diagnosis/results/diagnosis.hpp"
#include "diagnosis/search/effect_tests.hpp"
#include "diagnosis/search/weighing.hpp"

namespace tether {

/// One attempt to add an effect.
struct SearchStep {
  std::size_t candidate = 0;
  std::optional<Objection> objection;  ///< none: it is accepted
  double misfit_before = 0, misfit_after = 0;
  LackOfFit left;
  bool accepted() const { return !objection; }
};

struct SearchResult {
  Verdict verdict = Verdict::undecided;
  Weighed weighed;                    ///< how probable each explanation is
  std::vector<TestedEffect> effects;  ///< accepted ones first, then by their evidence
  MatrixXd cosines;                   ///< of the changes that the first of `effects` make, each with each other
  std::vector<SearchStep> path;
  LackOfFit before, after;
  VectorXd amplitudes;     ///< of all accepted effects [q]
  VectorXd residual;       ///< with them [n]
  double independent = 0;  ///< number of independent training data
  bool more = false;       ///< another effect is wanted, but `most` were added
  double dispersion = 1;   ///< misfit per independent datum that is left, at least 1, numbers that may be anything
                           ///< refitted: intervals are widened by its root
  std::optional<Gain> held_out;
  std::vector<StrainedError> strained;  ///< errors beyond twice what is allowed, the worst first
  std::vector<ShownRun> runs;           ///< that found amplitudes
  Adequacy adequacy;
  bool doubtful = false;  ///< more is left than noise and errors allowed make by chance, though no more than they may
};

/// Tests every candidate, finds the amplitudes of the strongest with runs, accepts one effect at a time as long as the
/// data at hand and those held out ask for it, and judges what is left. finer: of a finer model, if there is one.
/// (D.8-D.13)
SearchResult search_effects(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at,
                            const Weighing& weighing, const ResidualAt& finer = {});
SearchResult search_effects(const EffectProblem& problem, const SearchSettings& settings,
                            const ResidualAt& residual_at);

}  // namespace tether
