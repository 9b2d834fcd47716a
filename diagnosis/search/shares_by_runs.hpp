#pragma once

#include "diagnosis/search/effect_tests.hpp"
#include "diagnosis/search/posterior.hpp"

namespace tether {

/// Of a group with one accepted member, those that runs tried share what the table gave them by what these runs remove
/// of the misfit, after the price of their sizes (D.10): the table adds up what each does by itself, which runs of all
/// together need not bear out. Their values are those of the runs. A rival that is in no group is added to that of what
/// it may stand for. independent: number of data; rival_of: of each candidate, itself if it is none. (D.19)
void share_by_runs(Weighed& weighed, const std::vector<TestedEffect>& effects, const EffectProblem& problem,
                   double independent, const std::vector<std::size_t>& rival_of);

}  // namespace tether
