#pragma once

#include "diagnosis/search/posterior.hpp"

namespace tether {

/// Why a run is wanted.
enum class RunsFor {
  exploring,  ///< what may matter, at any size: runs of a coarser model will do
  telling     ///< what is probable, at its size
};
/// Runs that would change what the table says: of candidates by themselves, at the amplitudes [q x m] that are most
/// probable, where no run is near. Of those that explain the data only with another, larger ones too: the two together
/// may be one that does something else when it is large; telling, of the set that leads.
MatrixXd wanted_runs(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior,
                     RunsFor purpose);

/// Runs of a finer model that are wanted of what leads: of members of probable sets and of what may stand in place of
/// one, and of the most probable that explains the data by itself, at the size of the closest run of the model itself
/// [q x m]; each once. shown: runs that were made.
MatrixXd wanted_refined(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior,
                        const std::vector<ShownRun>& shown);
/// Whether a run of a candidate by itself is of a size that the table was made without.
bool shows_more(const std::vector<ShownRun>& runs, const EffectProblem& problem, const std::vector<ShownRun>& shown);

}  // namespace tether
