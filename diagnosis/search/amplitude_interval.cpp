#include "diagnosis/search/amplitude_interval.hpp"

#include <cmath>

namespace tether {
namespace {

constexpr double outside = 0.025;    ///< probability on either side
constexpr double negligible = 1e-3;  ///< of the sets that hold the candidate

/// Amplitudes of which each cell between two neighbours' middles is as probable throughout.
class Mixture {
 public:
  void add(const AmplitudeDensity& density, double weight) {
    const Eigen::Index n = density.sizes.size();
    Part part{VectorXd(n + 1), VectorXd::Zero(n + 1)};
    part.ends.segment(1, n - 1) = (density.sizes.head(n - 1) + density.sizes.tail(n - 1)) / 2;
    part.ends(0) = 2 * density.sizes(0) - part.ends(1);
    part.ends(n) = 2 * density.sizes(n - 1) - part.ends(n - 1);
    for (Eigen::Index k = 0; k < n; ++k) part.below(k + 1) = part.below(k) + weight * density.probabilities(k);
    least_ = std::min(least_, part.ends(0));
    most_ = std::max(most_, part.ends(n));
    all_ += part.below(n);
    parts_.push_back(std::move(part));
  }
  bool is_empty() const { return !(all_ > 0); }

  /// By halves, to 1e-9 of the range.
  double quantile(double probability) const {
    double from = least_, to = most_;
    for (int step = 0; step < 30; ++step) (below((from + to) / 2) < probability * all_ ? from : to) = (from + to) / 2;
    return (from + to) / 2;
  }

 private:
  struct Part {
    VectorXd ends, below;
  };
  double below(double size) const {
    double sum = 0;
    for (const Part& part : parts_) {
      const Eigen::Index n = part.ends.size();
      const auto k = std::upper_bound(part.ends.begin(), part.ends.end(), size) - part.ends.begin();
      if (k == 0) continue;
      if (k == n) {
        sum += part.below(n - 1);
        continue;
      }
      const double share = (size - part.ends(k - 1)) / (part.ends(k) - part.ends(k - 1));
      sum += part.below(k - 1) + share * (part.below(k) - part.below(k - 1));
    }
    return sum;
  }

  std::vector<Part> parts_;
  double least_ = infinite, most_ = -infinite, all_ = 0;
};

/// Of one set, at each size of the discrepancy.
void add(Mixture& mixture, const SetEvidence& evidence, const EffectSet& set, const OneOfSeveral& told) {
  const auto place = std::find(set.members.begin(), set.members.end(), told.candidate) - set.members.begin();
  const auto& sizes = evidence.discrepancies();
  std::vector<SetFit> fits;
  double best = -infinite;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    fits.push_back(evidence.fit(set.members, s));
    best = std::max(best, fits.back().log_evidence);
  }
  const auto is_more = [&](std::size_t s) { return sizes[s].size > 1; };
  double sums[2] = {0, 0};
  for (std::size_t s = 0; s < sizes.size(); ++s)
    sums[is_more(s)] += sizes[s].prior * std::exp(fits[s].log_evidence - best);
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const double all = is_more(s) ? set.with_more : set.probability + set.with_unseen,
                 share = sizes[s].prior * std::exp(fits[s].log_evidence - best) / sums[is_more(s)];
    if (!(all * share > 0)) continue;
    mixture.add(evidence.is_scalar(told.candidate) ? fits[s].densities[static_cast<std::size_t>(place)]
                                                   : evidence.density_of(told, set.members, s),
                all * share);
  }
}

}  // namespace

std::optional<AmplitudeInterval> amplitude_interval(const SetEvidence& evidence, const Posterior& posterior,
                                                    const OneOfSeveral& told) {
  const double all = posterior.of(told.candidate);
  Mixture mixture;
  for (const EffectSet& set : posterior.sets)
    if (set.has(told.candidate) && set.all() > negligible * all) add(mixture, evidence, set, told);
  if (mixture.is_empty()) return std::nullopt;
  return AmplitudeInterval{mixture.quantile(outside), mixture.quantile(0.5), mixture.quantile(1 - outside)};
}

void set_intervals(SearchResult& result, const EffectProblem& problem, const SearchSettings& settings,
                   std::vector<ShownRun> shown) {
  if (result.runs.empty()) return;
  shown.insert(shown.end(), result.runs.begin(), result.runs.end());
  const SetEvidence evidence(problem, shown);
  const Posterior posterior = posterior_of(problem, evidence, refused_in(problem, settings));
  for (TestedEffect& effect : result.effects)
    for (Eigen::Index own = 0; effect.confirmed && own < effect.amplitudes.size(); ++own)
      effect.intervals.push_back(amplitude_interval(evidence, posterior, {effect.candidate, own}));
}

}  // namespace tether
