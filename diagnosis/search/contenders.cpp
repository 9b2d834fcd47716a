#include "diagnosis/search/contenders.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

/// Share of a group's member that is named alone: 95 % though logarithms of evidence are off by 1, as between runs.
constexpr double alone = 0.98;

void add_in_its_place(std::vector<TestedEffect>& all, const WeighedGroup& group, std::vector<TestedEffect> tested,
                      const Trial& trial) {
  const TestedEffect first = of_candidate(tested, group.members.front());
  const std::vector<bool> refused = refused_in(trial.problem, trial.settings);
  std::stable_sort(tested.begin(), tested.end(), [](const auto& a, const auto& b) { return a.gain > b.gain; });
  for (const TestedEffect& other : tested) {
    const bool may_be_it = other.gain > tested.front().gain / 2 ||
                           std::pow(cosine(trial.problem, trial.scores, first, other), 2) > look_alike;
    if (may_be_it && static_cast<int>(all.size()) < trial.settings.confirmed && !group.has(other.candidate) &&
        !refused[other.candidate] && trial.problem.candidates[other.candidate].takes_runs())
      all.push_back(other);
  }
}

}  // namespace

std::vector<TestedEffect> contenders_of(const WeighedGroup& group, const Trial& trial) {
  const std::vector<TestedEffect> tested = test_all(trial.problem, trial.scores, trial.independent);
  std::vector<TestedEffect> all;
  for (std::size_t k = 0; k < group.members.size() && static_cast<int>(all.size()) < trial.settings.confirmed; ++k) {
    const bool as_good = k < group.as_good.size() && group.as_good[k];
    if (k > 0 && group.shares.front() >= alone && trial.is_first && !as_good) continue;
    TestedEffect& effect = all.emplace_back(of_candidate(tested, group.members[k]));
    if (std::isfinite(group.amplitudes[k])) effect.amplitudes(0) = group.amplitudes[k];
  }
  if (!trial.is_first) add_in_its_place(all, group, tested, trial);
  return all;
}

}  // namespace tether
