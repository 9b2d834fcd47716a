#pragma once

#include "diagnosis/results/probability_table.hpp"
#include "diagnosis/search/posterior.hpp"

namespace tether {

/// The same with names, units and values of the case in the place of candidates and amplitudes.
ProbabilityTable table_of(const EffectProblem& problem, const Weighed& weighed);

}  // namespace tether
