#pragma once

#include "diagnosis/results/located_misfit.hpp"
#include "diagnosis/search/confirmation.hpp"
#include "diagnosis/search/effect_search.hpp"
#include "diagnosis/search/refinement.hpp"

namespace tether {

/// Where a search ended.
struct SearchEnd {
  const EffectProblem& problem;
  const SearchSettings& settings;
  const Trained& trained;       ///< with what was accepted left free
  const AmplitudeState& state;  ///< with all that was accepted
  const Confirmation& confirmation;
  double misfit_as_it_is;                    ///< of the model without any
  const std::vector<std::size_t>& rival_of;  ///< for each candidate, the one that it could stand for; itself if none
};

/// Judges what is left, and what that says of the model: sets `strained`, `adequacy`, `doubtful`, `held_out` and
/// `verdict` of a result whose effects, path and lack of fit are known. (D.12, D.20)
void judge(const SearchEnd& end, SearchResult& result);

/// Beside a place of the wall that is farther off than any noise what is named is not known, and nothing is not all
/// that is missing. (D.24)
void judge_place(const std::optional<LocatedMisfit>& left, const EffectProblem& problem, SearchResult& result);

}  // namespace tether
