#include "diagnosis/search/shares_by_runs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/search/effect_tests.hpp"

namespace tether {
namespace {

/// Of `values` those at `order`; of what has none none.
template <class Values>
Values in_order(const Values& values, const std::vector<std::size_t>& order) {
  Values sorted;
  for (const std::size_t k : order)
    if (k < values.size()) sorted.push_back(values[k]);
  return sorted;
}

void put_most_probable_first(WeighedGroup& group) {
  std::vector<std::size_t> order(group.members.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return group.shares[a] > group.shares[b]; });
  group.members = in_order(group.members, order);
  group.shares = in_order(group.shares, order);
  group.amplitudes = in_order(group.amplitudes, order);
  group.by_runs = in_order(group.by_runs, order);
  group.as_good = in_order(group.as_good, order);
}

/// Rivals of the group's accepted ones, improbable by themselves, which have no line in the table.
void add_rivals(WeighedGroup& group, const std::vector<WeighedGroup>& groups, const std::vector<TestedEffect>& effects,
                const std::vector<std::size_t>& rival_of) {
  const auto is_told = [&](std::size_t candidate) {
    return std::any_of(groups.begin(), groups.end(), [&](const WeighedGroup& one) { return one.has(candidate); });
  };
  for (const TestedEffect& effect : effects) {
    const std::size_t of = rival_of[effect.candidate];
    if (!effect.rival || is_told(effect.candidate) || !group.has(of) || !of_candidate(effects, of).accepted) continue;
    group.members.push_back(effect.candidate);
    group.shares.push_back(0);
    group.amplitudes.push_back(undefined);
    group.by_runs.push_back(false);
  }
}

}  // namespace

void share_by_runs(Weighed& weighed, const std::vector<TestedEffect>& effects, const EffectProblem& problem,
                   double independent, const std::vector<std::size_t>& rival_of) {
  for (WeighedGroup& group : weighed.groups) {
    add_rivals(group, weighed.groups, effects, rival_of);
    std::vector<std::size_t> tried;  // places within the group
    double together = 0, most = -infinite;
    int accepted = 0;
    for (std::size_t k = 0; k < group.members.size(); ++k) {
      const TestedEffect& effect = of_candidate(effects, group.members[k]);
      if (!effect.confirmed) continue;
      accepted += effect.accepted ? 1 : 0;
      tried.push_back(k);
      together += group.shares[k];
      most = std::max(most, worth(problem, effect, independent));
    }
    if (accepted != 1 || tried.size() < 2) continue;  // two of one group are there together
    double sum = 0;
    for (const std::size_t k : tried) {
      const TestedEffect& effect = of_candidate(effects, group.members[k]);
      group.shares[k] = std::exp((worth(problem, effect, independent) - most) / 2);
      sum += group.shares[k];
      if (effect.amplitudes.size() == 1) group.amplitudes[k] = effect.amplitudes(0);
      group.by_runs[k] = true;
    }
    for (const std::size_t k : tried) group.shares[k] *= together / sum;
    put_most_probable_first(group);
  }
}

}  // namespace tether
