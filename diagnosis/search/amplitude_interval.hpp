#pragma once

#include "diagnosis/search/effect_search.hpp"

namespace tether {

/// The 95 % interval of one of a candidate's amplitudes where it is there, whatever else is there beside: over all sets
/// that it is in and all sizes of the discrepancy, each as probable as it is. Nothing of one that no set holds. (D.10)
std::optional<AmplitudeInterval> amplitude_interval(const SetEvidence& evidence, const Posterior& posterior,
                                                    const OneOfSeveral& told);

/// Of the effects that runs confirmed, with what those runs and earlier ones showed.
void set_intervals(SearchResult& result, const EffectProblem& problem, const SearchSettings& settings,
                   std::vector<ShownRun> shown);

}  // namespace tether
