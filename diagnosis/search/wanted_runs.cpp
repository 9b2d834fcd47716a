#include "diagnosis/search/wanted_runs.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace tether {
namespace {

constexpr double matters_still = 3.5;  ///< logarithm of evidence
constexpr double much_alike = 0.8;     ///< squared cosine of laws that only runs tell apart
constexpr double leads = 0.5;          ///< probability of a set whose members are compared with those
constexpr double wrong = 0.15;         ///< share of a gain that a run at another size may be off

/// Runs of candidates by themselves that would change what the table says.
class Wanted {
 public:
  Wanted(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior, RunsFor purpose)
      : problem_(problem), evidence_(evidence), posterior_(posterior), exploring_(purpose == RunsFor::exploring) {}

  /// Of sets that are not improbable, the members that the data ask for; much larger ones too as long as no candidate
  /// explains the data by itself: several may be one that does at its size what smaller ones do not. At the end only of
  /// a set that leads.
  void add_likely() {
    constexpr double matters = 0.01, much_larger = 5;
    const bool needs_several = alone() < 0.5;
    for (const EffectSet& set : posterior_.sets) {
      if (set.probability + set.with_more < matters) continue;
      const SetFit fit = evidence_.fit(set.members, 0);
      for (std::size_t k = 0; k < set.members.size(); ++k) {
        const std::size_t c = set.members[k];
        const double size = fit.amplitudes[k];
        if (!can_be_run(c, size) || !is_asked_for(c)) continue;
        const double larger = amplitude_of(c).limited(much_larger * size);
        if (is_far_from_runs(c, size)) wanted_.emplace(c, size);
        if (needs_several && (exploring_ || set.all() > leads) && evidence_.is_beyond_all(c, larger / 2))
          wanted_.emplace(c, larger);
      }
    }
  }

  /// Those that fall behind the best by less than what a run at another size may be wrong by.
  void add_promising() {
    const double nothing = evidence_.fit({}, 0).log_evidence;
    std::vector<std::pair<double, std::pair<std::size_t, double>>> all;
    double best = nothing;
    for (std::size_t c = 0; c < problem_.candidates.size(); ++c) {
      const SetFit fit = evidence_.fit({c}, 0);
      best = std::max(best, fit.log_evidence);
      if (can_be_run(c, fit.amplitudes[0]) && is_far_from_runs(c, fit.amplitudes[0]))
        all.push_back({fit.log_evidence + wrong * (fit.log_evidence - nothing), {c, fit.amplitudes[0]}});
    }
    for (const auto& [hope, run] : all)
      if (hope > best - matters_still && hope > nothing + matters_still) wanted_.insert(run);
  }

  /// Of probable sets, what may stand in place of a member: it does much the same, and falls behind by less than what a
  /// run at another size, or of a coarser model, may be wrong by. At the end all that do very much the same, so that
  /// their moments can be compared, unless runs have shown that they explain less than half of it.
  void add_alternatives() {
    for (const EffectSet& set : probable_sets())
      for (const std::size_t member : set.members)
        for (const Alternative& other : alternatives(set, member)) {
          const bool is_compared = !exploring_ && other.alike > much_alike && set.all() > leads && other.explains_half;
          if ((is_compared || other.may_be_it) && can_be_run(other.candidate, other.size) &&
              is_far_from_runs(other.candidate, other.size))
            wanted_.emplace(other.candidate, other.size);
        }
  }

  /// On a finer mesh: of probable sets the members and what may be in place of one, and the most probable that explains
  /// the data by itself; each at the size of the closest run of the model itself.
  void add_refined(const std::vector<ShownRun>& shown) {
    const auto alone = std::find_if(posterior_.sets.begin(), posterior_.sets.end(), [&](const EffectSet& set) {
      return set.members.size() == 1 && problem_.candidates[set.members.front()].takes_runs();
    });
    std::vector<EffectSet> sets = probable_sets();
    if (alone != posterior_.sets.end()) sets.push_back(*alone);
    for (const EffectSet& set : sets) {
      const SetFit fit = evidence_.fit(set.members, 0);
      for (std::size_t k = 0; k < set.members.size(); ++k) {
        refine(set.members[k], fit.amplitudes[k], shown);
        for (const Alternative& other : alternatives(set, set.members[k]))
          if (other.may_be_it) refine(other.candidate, other.size, shown);
      }
    }
  }

  MatrixXd runs() const {
    MatrixXd all = MatrixXd::Zero(problem_.changes.cols(), static_cast<Eigen::Index>(wanted_.size()));
    Eigen::Index column = 0;
    for (const auto& [candidate, amplitude] : wanted_)
      all(problem_.candidates[candidate].amplitudes.front(), column++) = amplitude;
    return all;
  }

 private:
  /// What may stand in place of a member of a set: it does much the same.
  struct Alternative {
    std::size_t candidate;
    double size, alike;             ///< squared cosine
    bool explains_half, may_be_it;  ///< of what the member explains; even if a run at its size is off
  };

  std::vector<EffectSet> probable_sets() const {
    constexpr double probable = 0.05;
    std::vector<EffectSet> sets;
    for (const EffectSet& set : posterior_.sets)
      if (set.probability + set.with_more >= probable) sets.push_back(set);
    return sets;
  }

  std::vector<Alternative> alternatives(const EffectSet& set, std::size_t member) const {
    const double best = evidence_.fit(set.members, 0).log_evidence;
    std::vector<std::size_t> with = set.members;
    std::erase(with, member);
    const double without = evidence_.fit(with, 0).log_evidence;
    with.push_back(0);
    std::vector<Alternative> all;
    for (std::size_t c = 0; c < problem_.candidates.size(); ++c) {
      const double alike = std::pow(evidence_.cosine(c, member), 2);
      if (alike <= look_alike || std::count(set.members.begin(), set.members.end(), c) > 0) continue;
      with.back() = c;
      const SetFit fit = evidence_.fit(with, 0);
      const double gain = fit.log_evidence - without, hope = gain + wrong * gain;
      all.push_back(
          {c, fit.amplitudes.back(), alike, gain > (best - without) / 2, hope > best - without - matters_still});
    }
    return all;
  }

  void refine(std::size_t c, double size, const std::vector<ShownRun>& shown) {
    if (!can_be_run(c, size)) return;
    const Eigen::Index own = problem_.candidates[c].amplitudes.front();
    const bool is_there = std::any_of(shown.begin(), shown.end(), [&](const ShownRun& run) {
      return run.of == RunOf::finer && run.amplitudes(own) != 0;
    });
    if (const auto closest = evidence_.closest_run(c, size); closest && !is_there) wanted_.emplace(c, *closest);
  }

  bool is_far_from_runs(std::size_t c, double size) const {
    return evidence_.beyond_runs(c, size, exploring_) > near_a_run;
  }
  const Amplitude& amplitude_of(std::size_t c) const {
    return problem_.amplitudes[static_cast<std::size_t>(problem_.candidates[c].amplitudes.front())];
  }
  bool can_be_run(std::size_t c, double size) const {
    const auto has = [&](const auto& run) { return run.first == c; };
    return problem_.candidates[c].takes_runs() && std::isfinite(size) && size != 0 && !posterior_.left_out[c] &&
           std::none_of(wanted_.begin(), wanted_.end(), has);
  }
  bool is_asked_for(std::size_t c) const {
    constexpr double likely = 0.05, told = 3;
    const double p = posterior_.of(c);
    return p > likely && p / (1 - p) > told * posterior_.prior[c];
  }
  /// The probability that at most one candidate is needed.
  double alone() const {
    double sum = posterior_.nothing + posterior_.outside;
    for (const EffectSet& set : posterior_.sets)
      if (set.members.size() == 1) sum += set.probability + set.with_more;
    return sum;
  }

  const EffectProblem& problem_;
  const SetEvidence& evidence_;
  const Posterior& posterior_;
  bool exploring_;
  std::set<std::pair<std::size_t, double>> wanted_;  ///< candidates and amplitudes
};

}  // namespace

MatrixXd wanted_refined(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior,
                        const std::vector<ShownRun>& shown) {
  Wanted wanted(problem, evidence, posterior, RunsFor::telling);
  wanted.add_refined(shown);
  return wanted.runs();
}

MatrixXd wanted_runs(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior,
                     RunsFor purpose) {
  Wanted wanted(problem, evidence, posterior, purpose);
  wanted.add_likely();
  wanted.add_promising();
  wanted.add_alternatives();
  return wanted.runs();
}

bool shows_more(const std::vector<ShownRun>& runs, const EffectProblem& problem, const std::vector<ShownRun>& shown) {
  const SetEvidence evidence(problem, shown);
  return std::any_of(runs.begin(), runs.end(), [&](const ShownRun& run) {
    if ((run.amplitudes.array() != 0).count() != 1 || !run.residual.allFinite()) return false;
    Eigen::Index own = 0;
    run.amplitudes.cwiseAbs().maxCoeff(&own);
    for (std::size_t c = 0; c < problem.candidates.size(); ++c)
      if (const auto& all = problem.candidates[c].amplitudes; all.size() == 1 && all.front() == own)
        return problem.candidates[c].takes_runs() && evidence.beyond_runs(c, run.amplitudes(own), false) > near_a_run;
    return false;
  });
}

}  // namespace tether
