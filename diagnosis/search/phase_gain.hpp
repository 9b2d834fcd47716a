#pragma once

#include "diagnosis/evidence/set_evidence.hpp"
#include "diagnosis/results/phase_gain.hpp"

namespace tether {

/// Moments of the data that may name something; none where there are fewer than four.
std::vector<int> foretold_moments(const EffectProblem& problem);

/// Of the data that may name something, those of all other moments.
std::vector<Eigen::Index> rows_but(const EffectProblem& problem, int moment);

/// By how much each moment's data are foretold better from all other data with a set of candidates than with another:
/// the logarithm of their probability, amplitudes and allowed errors free within what the others say of them. Data of
/// sources that are held out as a whole take no part. Nothing where there are fewer than four moments. (D.21)
///
/// with, without: numbers of candidates, at most three of one amplitude each.
std::optional<PhaseGain> phase_gain(const EffectProblem& problem, const std::vector<ShownRun>& runs,
                                    const std::vector<std::size_t>& with, const std::vector<std::size_t>& without);

/// Whether moments are foretold better with a probability of 95 %: as much as they differ from each other, or by the
/// odds of all but the fifth of them that says most for it. (D.21)
bool foretells(const PhaseGain& gain);

/// A gain whose moments differ by so much, of the normal distribution.
PhaseGain expected_gain(double value, double deviation, int moments);

}  // namespace tether
