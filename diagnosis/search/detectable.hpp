#pragma once

#include "diagnosis/search/posterior.hpp"

namespace tether {

/// Of each candidate the smallest size of its first amplitude at which it, or what does much the same in its place,
/// would be named in 80 of 100 such data sets [q]: were it all that the model lacks, and the model itself as far off as
/// these data say. Negative where only smaller values than the model's are admissible, infinite where no size is named.
/// (D.12)
///
/// runs: what showed what candidates do. alpha: of the chance that noise makes as much of any candidate.
std::vector<double> detectable_sizes(const EffectProblem& problem, const std::vector<ShownRun>& runs,
                                     const Posterior& posterior, double alpha);

}  // namespace tether
