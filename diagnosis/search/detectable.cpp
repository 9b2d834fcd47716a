#include "diagnosis/search/detectable.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/search/effect_tests.hpp"
#include "diagnosis/search/phase_gain.hpp"

namespace tether {
namespace {

constexpr double named_at = 0.95;              ///< probability of what is named, and that moments are foretold better
constexpr double in_80_of_100 = 0.842;         ///< quantile of the normal distribution
constexpr double faint = 2.5;                  ///< deviations of a signal that is named by none
constexpr double wider = 1.3, precise = 1.02;  ///< of a size, as factors
constexpr int most_steps = 40;

/// What would be named if one candidate were all that the model lacks.
class Power {
 public:
  Power(const EffectProblem& problem, const std::vector<ShownRun>& runs, const Posterior& posterior, double alpha)
      : problem_(problem), evidence_(problem, runs), supposed_(evidence_), posterior_(posterior), alpha_(alpha) {
    for (const int moment : foretold_moments(problem))
      without_.emplace_back(problem, runs, Assumptions{}, rows_but(problem, moment));
    if (naming_rows(problem).size() > problem.training.size())
      training_.emplace(problem, runs, Assumptions{}, problem.training);
    const auto& sizes = evidence_.discrepancies();
    const auto nearest = std::min_element(sizes.begin(), sizes.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.size - posterior.discrepancy) < std::abs(b.size - posterior.discrepancy);
    });
    expected_ = static_cast<std::size_t>(nearest - sizes.begin());
  }

  double size_of(std::size_t candidate) {
    const Amplitude& first = first_of(candidate);
    const double little = (first.limited(1e-6) > 0 ? 1e-6 : -1e-6) * (first.scale > 0 ? first.scale : 1);
    const double signal = signal_of(candidate, little);
    if (!(signal > 0)) return infinite;
    const std::vector<std::size_t> group = group_of(candidate);
    double seen = little * faint / signal, unseen = seen;
    for (int k = 0; !is_named(candidate, seen, group); ++k, seen *= wider) {
      if (k == most_steps || first.limited(seen) != seen) return infinite;
      unseen = seen;
    }
    while (seen / unseen > precise) {
      const double between = unseen * std::sqrt(seen / unseen);
      (is_named(candidate, between, group) ? seen : unseen) = between;
    }
    return seen;
  }

 private:
  const Amplitude& first_of(std::size_t candidate) const {
    return problem_.amplitudes[static_cast<std::size_t>(problem_.candidates[candidate].amplitudes.front())];
  }
  /// What does much the same, itself first.
  std::vector<std::size_t> group_of(std::size_t candidate) const {
    std::vector<std::size_t> group{candidate};
    for (std::size_t c = 0; c < problem_.candidates.size(); ++c)
      if (c != candidate && !posterior_.left_out[c] && std::pow(evidence_.cosine(c, candidate), 2) > look_alike)
        group.push_back(c);
    return group;
  }
  double signal_of(std::size_t candidate, double size) {
    supposed_.suppose(candidate, size);
    return supposed_.signal(expected_);
  }
  /// By how much more probable what is supposed is with a candidate than with none, as a logarithm.
  double lead(const SetEvidence& supposed, std::size_t candidate) const {
    return supposed.fit({candidate}, expected_).log_evidence - supposed.fit({}, expected_).log_evidence;
  }
  bool is_named(std::size_t candidate, double size, const std::vector<std::size_t>& group) {
    const double signal = signal_of(candidate, size), left = signal - in_80_of_100;
    if (!(left > 0) || !is_beyond_chance(candidate, left)) return false;
    supposed_.suppose(candidate, size, left / signal);
    return is_probable(group) && is_confirmed(candidate, size, left / signal);
  }
  bool is_beyond_chance(std::size_t candidate, double signal) const {
    return static_cast<double>(problem_.candidates.size()) * chance_of(problem_, candidate, signal * signal) < alpha_;
  }
  /// Noise makes others as probable as they were beforehand, in the mean.
  bool is_probable(const std::vector<std::size_t>& group) const {
    double odds = 0, others = 1;
    for (std::size_t c = 0; c < posterior_.prior.size(); ++c)
      if (!posterior_.left_out[c] && std::find(group.begin(), group.end(), c) == group.end())
        others += posterior_.prior[c];
    for (const std::size_t c : group) odds += posterior_.prior[c] * std::exp(lead(supposed_, c));
    return odds > named_at / (1 - named_at) * others;
  }
  bool is_confirmed(std::size_t candidate, double size, double share) {
    if (!problem_.candidates[candidate].confirmable || (without_.empty() && !training_)) return true;
    return is_foretold(candidate, size, share) || is_shown_by_held_out(candidate, size, share);
  }
  /// By the misfit of held-out data given the others, which noise gives a deviation of twice the root of its mean.
  bool is_shown_by_held_out(std::size_t candidate, double size, double share) {
    if (!training_) return false;
    training_->suppose(candidate, size, share);
    const double seen = supposed_.signal(expected_), at_hand = training_->signal(expected_);
    return std::sqrt(std::max(0.0, seen * seen - at_hand * at_hand)) / 2 > normal_quantile(named_at);
  }
  /// Gains differ from moment to moment as what the candidate does there, and by noise, which gives a logarithm of odds
  /// twice its mean as variance.
  bool is_foretold(std::size_t candidate, double size, double share) {
    if (without_.empty()) return false;
    VectorXd gains = VectorXd::Constant(std::ssize(without_), lead(supposed_, candidate));
    for (std::size_t m = 0; m < without_.size(); ++m) {
      without_[m].suppose(candidate, size, share);
      gains(static_cast<Eigen::Index>(m)) -= lead(without_[m], candidate);
    }
    const auto n = static_cast<double>(gains.size());
    const double gain = gains.sum(), differ = n / (n - 1) * (gains.array() - gains.mean()).square().sum();
    return gain > 0 && foretells(expected_gain(gain, std::sqrt(differ + 2 * gain), static_cast<int>(n)));
  }

  const EffectProblem& problem_;
  SetEvidence evidence_, supposed_;
  std::vector<SetEvidence> without_;     ///< each moment, of what is supposed
  std::optional<SetEvidence> training_;  ///< of what is supposed; none if no data are held out
  const Posterior& posterior_;
  double alpha_;
  std::size_t expected_ = 0;  ///< discrepancy
};

}  // namespace

std::vector<double> detectable_sizes(const EffectProblem& problem, const std::vector<ShownRun>& runs,
                                     const Posterior& posterior, double alpha) {
  Power power(problem, runs, posterior, alpha);
  std::vector<double> sizes;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) sizes.push_back(power.size_of(c));
  return sizes;
}

}  // namespace tether
