#include "diagnosis/search/detectable.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double named_at = 0.95;              ///< probability of what is named
constexpr double in_80_of_100 = 0.842;         ///< quantile of the normal distribution
constexpr double faint = 2.5;                  ///< deviations of a signal that is named by none
constexpr double wider = 1.3, precise = 1.02;  ///< of a size, as factors
constexpr double much_the_same = 0.5;          ///< squared cosine
constexpr int most_steps = 40;

/// What would be probable if one candidate were all that the model lacks.
class Power {
 public:
  Power(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior)
      : problem_(problem), evidence_(evidence), supposed_(evidence), posterior_(posterior) {
    const auto& sizes = evidence.discrepancies();
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
    return std::abs(seen);
  }

 private:
  const Amplitude& first_of(std::size_t candidate) const {
    return problem_.amplitudes[static_cast<std::size_t>(problem_.candidates[candidate].amplitudes.front())];
  }
  /// What does much the same, itself first.
  std::vector<std::size_t> group_of(std::size_t candidate) const {
    std::vector<std::size_t> group{candidate};
    for (std::size_t c = 0; c < problem_.candidates.size(); ++c)
      if (c != candidate && !posterior_.left_out[c] && std::pow(evidence_.cosine(c, candidate), 2) > much_the_same)
        group.push_back(c);
    return group;
  }
  double signal_of(std::size_t candidate, double size) {
    supposed_.suppose(candidate, size);
    return supposed_.signal(expected_);
  }
  bool is_named(std::size_t candidate, double size, const std::vector<std::size_t>& group) {
    const double signal = signal_of(candidate, size);
    if (!(signal > in_80_of_100)) return false;
    supposed_.suppose(candidate, size, 1 - in_80_of_100 / signal);
    const double nothing = supposed_.log_evidence({});
    double odds = 0;
    for (const std::size_t c : group) odds += posterior_.prior[c] * std::exp(supposed_.log_evidence({c}) - nothing);
    return odds > named_at / (1 - named_at);
  }

  const EffectProblem& problem_;
  const SetEvidence& evidence_;
  SetEvidence supposed_;
  const Posterior& posterior_;
  std::size_t expected_ = 0;  ///< discrepancy
};

}  // namespace

std::vector<double> detectable_sizes(const EffectProblem& problem, const SetEvidence& evidence,
                                     const Posterior& posterior) {
  Power power(problem, evidence, posterior);
  std::vector<double> sizes;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) sizes.push_back(power.size_of(c));
  return sizes;
}

}  // namespace tether
