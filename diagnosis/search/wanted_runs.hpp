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

}  // namespace tether
