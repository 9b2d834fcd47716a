#include "diagnosis/search/phase_gain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "diagnosis/comparison/chances.hpp"

namespace tether {
namespace {

using Members = std::vector<std::size_t>;

constexpr std::size_t fewest_moments = 4;
constexpr double foretold_surely = 0.95;  ///< probability

/// By how much more probable the data are with one set than with the other, as a logarithm.
double lead(const SetEvidence& evidence, const Members& with, const Members& without) {
  return evidence.log_evidence(with) - evidence.log_evidence(without);
}

/// That there is any gain, by how the moments differ.
double chance_of_any(const PhaseGain& gain) {
  if (!(gain.deviation > 0)) return gain.value > 0 ? 1 : 0;
  return 1 - student_tail(gain.value / gain.deviation, gain.moments - 1);
}

/// Their sum without the largest fifth of them, rounded up.
double without_best_fifth(std::vector<double> each) {
  std::sort(each.begin(), each.end());
  const auto left = static_cast<std::ptrdiff_t>(each.size() * 4 / 5);
  return std::accumulate(each.begin(), each.begin() + left, 0.0);
}

}  // namespace

std::vector<int> foretold_moments(const EffectProblem& problem) {
  std::set<int> moments;
  for (const Eigen::Index i : naming_rows(problem)) moments.insert(problem.moment[static_cast<std::size_t>(i)]);
  return moments.size() < fewest_moments ? std::vector<int>{} : std::vector<int>(moments.begin(), moments.end());
}

std::vector<Eigen::Index> rows_but(const EffectProblem& problem, int moment) {
  std::vector<Eigen::Index> rows = naming_rows(problem);
  std::erase_if(rows, [&](Eigen::Index i) { return problem.moment[static_cast<std::size_t>(i)] == moment; });
  return rows;
}

bool foretells(const PhaseGain& gain) {
  return gain.positive >= foretold_surely || gain.robust >= std::log(foretold_surely / (1 - foretold_surely));
}

/// Of normal numbers the lower 4/5 have 4/5 of the mean, less the density at the quantile times the deviation,
/// together.
PhaseGain expected_gain(double value, double deviation, int moments) {
  constexpr double density = 0.28;
  PhaseGain gain{value, deviation, moments};
  gain.positive = chance_of_any(gain);
  gain.robust = 0.8 * value - density * std::sqrt(moments) * deviation;
  return gain;
}

std::optional<PhaseGain> phase_gain(const EffectProblem& problem, const std::vector<ShownRun>& runs,
                                    const Members& with, const Members& without) {
  const std::vector<int> moments = foretold_moments(problem);
  if (moments.empty()) return std::nullopt;
  const double all = lead(SetEvidence(problem, runs), with, without);
  PhaseGain gain;
  std::vector<double> each;
  for (const int moment : moments) {
    each.push_back(all - lead(SetEvidence(problem, runs, {}, rows_but(problem, moment)), with, without));
    gain.better += each.back() > 0 ? 1 : 0;
  }
  gain.moments = static_cast<int>(each.size());
  gain.value = std::accumulate(each.begin(), each.end(), 0.0);
  gain.robust = without_best_fifth(each);
  const double n = gain.moments, squares = std::inner_product(each.begin(), each.end(), each.begin(), 0.0),
               variance = std::max(0.0, (squares - gain.value * gain.value / n) / (n - 1));
  gain.deviation = std::sqrt(n * variance);
  gain.positive = chance_of_any(gain);
  return gain;
}

}  // namespace tether
