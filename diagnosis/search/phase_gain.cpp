#include "diagnosis/search/phase_gain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "diagnosis/comparison/chances.hpp"

namespace tether {
namespace {

using Members = std::vector<std::size_t>;

constexpr int fewest_moments = 4;

/// Of the data that may name something.
std::set<int> moments_of(const EffectProblem& problem) {
  std::set<int> moments;
  for (const auto* rows : {&problem.training, &problem.held_out})
    for (const Eigen::Index i : *rows)
      if (std::count(problem.sealed.begin(), problem.sealed.end(), i) == 0)
        moments.insert(problem.moment[static_cast<std::size_t>(i)]);
  return moments;
}

EffectProblem without_moment(EffectProblem problem, int moment) {
  for (std::size_t i = 0; i < problem.moment.size(); ++i)
    if (problem.moment[i] == moment) problem.sealed.push_back(static_cast<Eigen::Index>(i));
  return problem;
}

/// By how much more probable the data are with one set than with the other, as a logarithm.
double lead(const EffectProblem& problem, const std::vector<ShownRun>& runs, const Members& with,
            const Members& without) {
  const SetEvidence evidence(problem, runs);
  return evidence.log_evidence(with) - evidence.log_evidence(without);
}

/// Their sum without the largest fifth of them, rounded up.
double without_best_fifth(std::vector<double> each) {
  std::sort(each.begin(), each.end());
  const auto left = static_cast<std::ptrdiff_t>(each.size() * 4 / 5);
  return std::accumulate(each.begin(), each.begin() + left, 0.0);
}

}  // namespace

std::optional<PhaseGain> phase_gain(const EffectProblem& problem, const std::vector<ShownRun>& runs,
                                    const Members& with, const Members& without) {
  const std::set<int> moments = moments_of(problem);
  if (static_cast<int>(moments.size()) < fewest_moments) return std::nullopt;
  const double all = lead(problem, runs, with, without);
  PhaseGain gain;
  std::vector<double> each;
  for (const int moment : moments) {
    each.push_back(all - lead(without_moment(problem, moment), runs, with, without));
    gain.better += each.back() > 0 ? 1 : 0;
  }
  gain.moments = static_cast<int>(each.size());
  gain.value = std::accumulate(each.begin(), each.end(), 0.0);
  gain.robust = without_best_fifth(each);
  const double n = gain.moments, squares = std::inner_product(each.begin(), each.end(), each.begin(), 0.0),
               variance = std::max(0.0, (squares - gain.value * gain.value / n) / (n - 1));
  gain.deviation = std::sqrt(n * variance);
  gain.positive = gain.deviation > 0 ? 1 - student_tail(gain.value / gain.deviation, gain.moments - 1)
                  : gain.value > 0   ? 1
                                     : 0;
  return gain;
}

}  // namespace tether
