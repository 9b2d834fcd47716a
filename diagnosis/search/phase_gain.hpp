#pragma once

#include "diagnosis/evidence/set_evidence.hpp"
#include "diagnosis/results/phase_gain.hpp"

namespace tether {

/// By how much each moment's data are foretold better from all other data with a set of candidates than with another:
/// the logarithm of their probability, amplitudes and allowed errors free within what the others say of them. Data of
/// sources that are held out as a whole take no part. Nothing where there are fewer than four moments. (D.21)
///
/// with, without: numbers of candidates, at most three of one amplitude each.
std::optional<PhaseGain> phase_gain(const EffectProblem& problem, const std::vector<ShownRun>& runs,
                                    const std::vector<std::size_t>& with, const std::vector<std::size_t>& without);

}  // namespace tether
