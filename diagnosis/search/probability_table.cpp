#include "diagnosis/search/probability_table.hpp"

#include <cmath>

namespace tether {
namespace {

Alternative alternative_of(const EffectProblem& problem, const WeighedGroup& group, std::size_t k) {
  const Candidate& candidate = problem.candidates[group.members[k]];
  Alternative one{candidate.name, std::nullopt, candidate.where, candidate.kind, group.shares[k],
                  std::nullopt,   "1",          group.by_runs[k]};
  if (!candidate.parameter.empty()) one.parameter = candidate.parameter;
  if (!std::isfinite(group.amplitudes[k])) return one;
  const Amplitude& amplitude = problem.amplitudes[static_cast<std::size_t>(candidate.amplitudes.front())];
  one.value = amplitude.value(group.amplitudes[k]);
  one.unit = amplitude.unit;
  return one;
}

}  // namespace

ProbabilityTable table_of(const EffectProblem& problem, const Weighed& weighed) {
  ProbabilityTable table;
  table.nothing = weighed.nothing;
  table.outside = weighed.outside;
  table.others = weighed.others;
  table.more = weighed.more;
  for (const WeighedGroup& group : weighed.groups) {
    AlternativeGroup& told =
        table.groups.emplace_back(AlternativeGroup{group.probability, group.least, group.foretold, {}});
    for (std::size_t k = 0; k < group.members.size(); ++k) told.members.push_back(alternative_of(problem, group, k));
  }
  for (const WeighedCombination& one : weighed.combinations)
    table.combinations.push_back({one.groups, one.probability});
  for (const WeighedOtherwise& one : weighed.otherwise)
    table.otherwise.push_back({one.what, one.factor, one.nothing, one.groups});
  return table;
}

}  // namespace tether
