#pragma once

#include "diagnosis/search/posterior.hpp"

namespace tether {

/// Of each candidate the smallest size of its first amplitude at which it, or what does much the same in its place,
/// would have a probability of 95 % in 80 of 100 such data sets [q]: were it all that the model lacks, and the model
/// itself as far off as these data say. Infinite where none is; of candidates that are left out undefined. (D.12)
std::vector<double> detectable_sizes(const EffectProblem& problem, const SetEvidence& evidence,
                                     const Posterior& posterior);

}  // namespace tether
