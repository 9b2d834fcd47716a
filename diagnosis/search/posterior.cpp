#include "diagnosis/search/posterior.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "diagnosis/search/phase_gain.hpp"

namespace tether {
namespace {

using Members = std::vector<std::size_t>;

/// Effects, wrong inputs, errors of data and of numerics that are expected beforehand.
double expected(CandidateKind kind) {
  switch (kind) {
    case CandidateKind::effect:
      return 0.5;
    case CandidateKind::input:
    case CandidateKind::data:
      return 0.2;
    case CandidateKind::numerics:
      break;
  }
  return 0.1;
}

const std::string& family(const Candidate& candidate) {
  return candidate.variant_of.empty() ? candidate.name : candidate.variant_of;
}

/// Of a family's odds: a part of a place has a quarter of what all of it has, which patches share.
double weight(const Candidate& candidate) {
  return (candidate.extent.is_all() ? 1 : 0.25) / candidate.one_of;
}

/// The logarithm of each candidate's odds beforehand: its kind's are shared alike by the families, those of a family
/// by its members.
std::vector<double> log_odds(const EffectProblem& problem) {
  std::map<CandidateKind, std::map<std::string, double>> weights;
  for (const Candidate& candidate : problem.candidates) weights[candidate.kind][family(candidate)] += weight(candidate);
  std::vector<double> all;
  for (const Candidate& candidate : problem.candidates) {
    const auto& families = weights[candidate.kind];
    all.push_back(std::log(expected(candidate.kind) * weight(candidate) /
                           (static_cast<double>(families.size()) * families.at(family(candidate)))));
  }
  return all;
}

constexpr double improbable = 7;  ///< logarithm of odds
/// Factor of the size within which a run tells what an amplitude does. Wider than `near_a_run`, at which runs are made,
/// so that one still counts when later runs have moved what is most probable.
constexpr double about = 1.5;

class Sets {
 public:
  Sets(const EffectProblem& problem, const SetEvidence& evidence, const std::vector<bool>& left_out)
      : evidence_(evidence), log_odds_(log_odds(problem)) {
    for (std::size_t c = 0; c < left_out.size(); ++c) {
      takes_runs_.push_back(problem.candidates[c].takes_runs());
      if (!left_out[c]) candidates_.push_back(c);
    }
  }

  Posterior posterior() {
    add({});
    for (const std::size_t c : candidates_) add({c});
    const std::vector<Members> singles = best(1, leading);
    for (const Members& one : singles)
      for (const std::size_t c : candidates_) add_beside(one, c);
    for (const Members& pair : best(2, 3)) {
      if (!counts(pair)) continue;
      for (const Members& one : singles) add_beside(pair, one.front());
      for (const std::size_t member : pair)
        for (const std::size_t c : partners(member)) add_beside(pair, c);
    }
    Posterior posterior = normalised();
    for (EffectSet& set : posterior.sets) set.by_runs = is_possible(set) && is_near_runs(set.members);
    return posterior;
  }

  /// Of sets that are not out of the question by another posterior, and of which runs of the model itself tell what
  /// they do, as things are assumed there or here: what saturates does much the same at another size.
  Posterior among(const Posterior& known) {
    for (std::size_t size = 0; size <= 3; ++size)
      for (const EffectSet& set : known.sets)
        if (set.members.size() == size && is_possible(set) && (set.by_runs || is_near_runs(set.members)))
          add(set.members);
    return normalised();
  }

 private:
  struct LogWeights {
    double as_it_is, with_more;  ///< logarithms
    double size;                 ///< of the discrepancy, as it is: expected
    double all() const { return std::max(as_it_is, with_more); }
  };

  static bool is_possible(const EffectSet& set) {
    constexpr double possible = 1e-4;
    return set.members.empty() || set.probability + set.with_more > possible;
  }
  /// At its most probable amplitudes.
  bool is_near_runs(const Members& members) const {
    const SetFit fit = evidence_.fit(members, 0);
    for (std::size_t k = 0; k < members.size(); ++k)
      if (takes_runs_[members[k]] && std::isfinite(fit.amplitudes[k]) &&
          evidence_.beyond_runs(members[k], fit.amplitudes[k], false) > about)
        return false;
    return true;
  }
  /// Whether a set is not improbable against the most probable one so far.
  bool counts(const Members& members) const {
    double most = -infinite;
    for (const auto& [set, weighed] : sets_) most = std::max(most, weighed.all());
    return sets_.at(members).all() > most - improbable;
  }
  /// Whether the discrepancy of an incomplete model is as probable as not, of a set without one of its members.
  bool may_need_more(const Members& members) const {
    if (members.size() < 2) return true;
    for (const std::size_t c : members) {
      Members rest = members;
      std::erase(rest, c);
      if (const auto found = sets_.find(rest);
          found != sets_.end() && found->second.with_more > found->second.as_it_is - improbable)
        return true;
    }
    return false;
  }

  void add_beside(Members members, std::size_t candidate) {
    const auto does_the_same = [&](std::size_t c) {
      return c == candidate || std::pow(evidence_.cosine(c, candidate), 2) > look_alike;
    };
    if (std::any_of(members.begin(), members.end(), does_the_same)) return;
    members.push_back(candidate);
    std::sort(members.begin(), members.end());
    add(members);
  }

  void add(const Members& members) {
    if (sets_.contains(members)) return;
    double prior = 0;
    for (const std::size_t c : members) prior += log_odds_[c];
    const auto& sizes = evidence_.discrepancies();
    LogWeights weighed{-infinite, -infinite, 0};
    const bool with_large = may_need_more(members);
    for (std::size_t s = 0; s < sizes.size(); ++s) {
      if (sizes[s].size > 1 && !with_large) continue;
      const double log = prior + std::log(sizes[s].prior) + evidence_.fit(members, s).log_evidence;
      double& to = sizes[s].size > 1 ? weighed.with_more : weighed.as_it_is;
      const double most = std::max(to, log);
      if (!std::isfinite(most)) continue;
      to = most + std::log(std::exp(to - most) + std::exp(log - most));
      if (sizes[s].size <= 1) weighed.size += (sizes[s].size - weighed.size) * std::exp(log - to);
    }
    sets_[members] = weighed;
  }

  std::vector<Members> best(std::size_t size, std::size_t most) const {
    std::vector<Members> all;
    for (const auto& [members, weighed] : sets_)
      if (members.size() == size) all.push_back(members);
    std::sort(all.begin(), all.end(),
              [&](const auto& a, const auto& b) { return sets_.at(a).all() > sets_.at(b).all(); });
    if (all.size() > most) all.resize(most);
    return all;
  }

  /// What is most probable beside a candidate. Where many that look alike lead, what explains the rest does not.
  Members partners(std::size_t candidate) const {
    std::vector<Members> pairs;
    for (const auto& [members, weighed] : sets_)
      if (members.size() == 2 && (members.front() == candidate || members.back() == candidate))
        pairs.push_back(members);
    std::sort(pairs.begin(), pairs.end(),
              [&](const auto& a, const auto& b) { return sets_.at(a).all() > sets_.at(b).all(); });
    if (pairs.size() > beside_each) pairs.resize(beside_each);
    Members all;
    for (const Members& pair : pairs) all.push_back(pair.front() == candidate ? pair.back() : pair.front());
    return all;
  }

  Posterior normalised() const {
    double most = -infinite, sum = 0, as_it_is = 0;
    for (const auto& [members, weighed] : sets_) most = std::max(most, weighed.all());
    Posterior posterior;
    posterior.discrepancy = 0;
    posterior.left_out.assign(log_odds_.size(), true);
    for (const std::size_t c : candidates_) posterior.left_out[c] = false;
    for (const double log : log_odds_) posterior.prior.push_back(std::exp(log));
    for (const auto& [members, weighed] : sets_) {
      posterior.sets.push_back({members, std::exp(weighed.as_it_is - most), std::exp(weighed.with_more - most)});
      as_it_is += posterior.sets.back().probability;
      posterior.discrepancy += posterior.sets.back().probability * weighed.size;
      sum += posterior.sets.back().probability + posterior.sets.back().with_more;
    }
    add_unseen(posterior);
    for (const EffectSet& set : posterior.sets) sum += set.with_unseen;
    for (double& unseen : posterior.unseen) unseen /= sum;
    for (EffectSet& set : posterior.sets) {
      set.probability /= sum;
      set.with_more /= sum;
      set.with_unseen /= sum;
      if (set.members.empty()) posterior.nothing = set.probability, posterior.outside = set.with_more;
    }
    posterior.discrepancy = as_it_is > 1e-9 * sum ? posterior.discrepancy / as_it_is : 1;
    std::stable_sort(posterior.sets.begin(), posterior.sets.end(),
                     [](const EffectSet& a, const EffectSet& b) { return a.all() > b.all(); });
    return posterior;
  }

  /// The most probable set of none or one.
  Members first() const {
    const Members one = best(1, 1).empty() ? Members{} : best(1, 1).front();
    return one.empty() || sets_.at({}).as_it_is > sets_.at(one).as_it_is ? Members{} : one;
  }

  /// Odds of each candidate that does not lead, beside the first set; no larger than beforehand. Of others 0.
  std::vector<double> hardly_shown() const {
    std::vector<bool> leads(log_odds_.size());
    for (const Members& one : best(1, leading)) leads[one.front()] = true;
    std::vector<double> odds(log_odds_.size());
    const Members known = first();
    for (const std::size_t c : candidates_) {
      Members with = known;
      with.insert(std::upper_bound(with.begin(), with.end(), c), c);
      const auto found = sets_.find(with);
      if (!leads[c] && found != sets_.end())
        odds[c] = std::exp(std::min(log_odds_[c], found->second.as_it_is - sets_.at(known).as_it_is));
    }
    return odds;
  }

  /// Beside each set of leading candidates any two or more of the others may be: of many that the data hardly show
  /// that is no small thing.
  void add_unseen(Posterior& posterior) const {
    const std::vector<double> odds = hardly_shown();
    double any = 1, single = 0;
    for (const double one : odds) any *= 1 + one, single += one;
    posterior.unseen.assign(odds.size(), 0);
    for (EffectSet& set : posterior.sets) {
      if (std::any_of(set.members.begin(), set.members.end(), [&](std::size_t c) { return odds[c] > 0; })) continue;
      set.with_unseen = set.probability * (any - 1 - single);
      for (std::size_t c = 0; c < odds.size(); ++c)
        posterior.unseen[c] += set.probability * odds[c] * (any / (1 + odds[c]) - 1);
    }
  }

  static constexpr std::size_t leading = 10;  ///< candidates that are looked at with each other
  static constexpr std::size_t beside_each = 5;

  const SetEvidence& evidence_;
  std::vector<double> log_odds_;
  std::vector<bool> takes_runs_;
  Members candidates_;
  std::map<Members, LogWeights> sets_;
};

/// By what factors what is assumed is wrong, at least now and then.
const std::map<Assumed, std::array<double, 2>> otherwise{
    {Assumed::sizes, {0.5, 2}}, {Assumed::noise, {1 / 1.3, 1.3}}, {Assumed::discrepancy, {0.5, 2}}};

/// Smallest probability of a candidate that is told, and of one that counts where it does much the same as what is.
constexpr double listed = 0.01, counted = 1e-3;

/// Those first that the data can least do without; each is made about its most probable member.
std::vector<WeighedGroup> groups_of(const SetEvidence& evidence, const Posterior& posterior) {
  std::vector<double> each;
  for (std::size_t c = 0; c < posterior.prior.size(); ++c) each.push_back(posterior.of(c));
  Members order;
  for (std::size_t c = 0; c < each.size(); ++c)
    if (each[c] >= listed) order.push_back(c);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return each[a] > each[b]; });
  std::vector<WeighedGroup> groups;
  for (const std::size_t c : order) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const WeighedGroup& group) {
      return std::pow(evidence.cosine(group.members.front(), c), 2) > look_alike;
    });
    (same == groups.end() ? groups.emplace_back() : *same).members.push_back(c);
  }
  for (std::size_t c = 0; c < each.size(); ++c) {
    if (each[c] >= listed || each[c] < counted) continue;
    for (WeighedGroup& group : groups)
      if (std::pow(evidence.cosine(group.members.front(), c), 2) > look_alike) {
        group.faint.push_back(c);
        break;
      }
  }
  for (WeighedGroup& group : groups) group.probability = posterior.of_any(group.all());
  std::stable_sort(groups.begin(), groups.end(), [&](const auto& a, const auto& b) {
    return posterior.of_none(a.all()) < posterior.of_none(b.all());
  });
  return groups;
}

/// Of each member, how probable it is that it is the group's only one, among these.
std::vector<double> shares_of(const WeighedGroup& group, const Posterior& posterior) {
  std::vector<double> shares(group.members.size());
  double sum = 0;
  for (const EffectSet& set : posterior.sets) {
    const auto own = [&](std::size_t c) { return group.has(c); };
    if (std::count_if(set.members.begin(), set.members.end(), own) != 1) continue;
    const std::size_t only = *std::find_if(set.members.begin(), set.members.end(), own);
    const auto place = std::find(group.members.begin(), group.members.end(), only) - group.members.begin();
    shares[static_cast<std::size_t>(place)] += set.all();
    sum += set.all();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

/// The most probable member first.
void describe(WeighedGroup& group, const EffectProblem& problem, const SetEvidence& evidence,
              const Posterior& posterior) {
  const std::vector<double> shares = shares_of(group, posterior);
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  const Members unordered = group.members;
  for (std::size_t k = 0; k < order.size(); ++k) {
    group.members[k] = unordered[order[k]];
    group.shares.push_back(shares[order[k]]);
  }
  for (const std::size_t c : group.members) {
    const double size = evidence.fit({c}, 0).amplitudes.front();
    group.amplitudes.push_back(size);
    group.by_runs.push_back(problem.candidates[c].takes_runs() && std::isfinite(size) &&
                            evidence.beyond_runs(c, size, false) < about);
  }
}

/// Numbers of the groups that a set's members are of, ascending; of what is not likely none.
std::vector<int> groups_in(const EffectSet& set, const std::vector<WeighedGroup>& groups) {
  std::vector<int> all;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (std::any_of(set.members.begin(), set.members.end(), [&](std::size_t c) { return groups[g].counts(c); }))
      all.push_back(static_cast<int>(g));
  return all;
}

struct Compared {
  const EffectProblem& problem;
  const std::vector<ShownRun>& runs;
  const Posterior& posterior;
};

/// Of what does much the same as the group's first, as a run showed, whether the first foretells the moments better,
/// even if a fifth of them is off.
void compare_moments(WeighedGroup& group, const Compared& of, const EffectSet& best) {
  const double told = std::log(0.98 / 0.02);
  const SetEvidence evidence(of.problem, of.runs);
  const std::size_t first = group.members.front();
  group.as_good.assign(group.members.size(), false);
  for (std::size_t c = 0; c < of.problem.candidates.size(); ++c) {
    if (c == first || of.posterior.left_out[c] || !of.problem.candidates[c].takes_runs() ||
        std::pow(evidence.cosine(first, c), 2) <= look_alike || best.has(c))
      continue;
    Members instead = best.members;
    std::replace(instead.begin(), instead.end(), first, c);
    const auto place = std::find(instead.begin(), instead.end(), c) - instead.begin();
    const double size = evidence.fit(instead, 0).amplitudes[static_cast<std::size_t>(place)];
    if (!std::isfinite(size) || evidence.beyond_runs(c, size, false) > about) continue;
    const auto gain = phase_gain(of.problem, of.runs, best.members, instead);
    if (!gain || gain->robust >= told) continue;
    const auto own = std::find(group.members.begin(), group.members.end(), c) - group.members.begin();
    if (own == std::ssize(group.members)) {
      group.members.push_back(c);
      group.shares.push_back(0);
      group.amplitudes.push_back(size);
      group.by_runs.push_back(true);
      group.as_good.push_back(true);
    } else {
      group.as_good[static_cast<std::size_t>(own)] = true;
    }
  }
}

}  // namespace

bool WeighedGroup::has(std::size_t candidate) const {
  return std::find(members.begin(), members.end(), candidate) != members.end();
}

bool WeighedGroup::counts(std::size_t candidate) const {
  return has(candidate) || std::find(faint.begin(), faint.end(), candidate) != faint.end();
}

std::vector<std::size_t> WeighedGroup::all() const {
  std::vector<std::size_t> together = members;
  together.insert(together.end(), faint.begin(), faint.end());
  return together;
}

double Posterior::of_any(const std::vector<std::size_t>& candidates) const {
  double sum = 0;
  for (const EffectSet& set : sets)
    if (std::any_of(candidates.begin(), candidates.end(),
                    [&](std::size_t c) { return std::binary_search(set.members.begin(), set.members.end(), c); }))
      sum += set.all();
  for (const std::size_t c : candidates) sum += unseen[c];
  return std::min(sum, 1.0);
}

double Posterior::of_none(const std::vector<std::size_t>& candidates) const {
  double sum = 0;
  for (const EffectSet& set : sets)
    if (std::none_of(candidates.begin(), candidates.end(), [&](std::size_t c) { return set.has(c); })) sum += set.all();
  return sum;
}

double Posterior::of(std::size_t candidate) const {
  return of_any({candidate});
}

Posterior posterior_of(const EffectProblem& problem, const SetEvidence& evidence, const std::vector<bool>& left_out) {
  return Sets(problem, evidence, left_out).posterior();
}

Weighed weighed(const EffectProblem& problem, const SetEvidence& evidence, const Posterior& posterior) {
  Weighed all{
      posterior.nothing, posterior.outside, 0, 0, posterior.discrepancy, groups_of(evidence, posterior), {}, {}, {}};
  for (WeighedGroup& group : all.groups) describe(group, problem, evidence, posterior);
  std::map<std::vector<int>, double> combined;
  for (const EffectSet& set : posterior.sets) {
    all.others += set.with_unseen;
    if (set.members.empty()) continue;
    const double probability = set.probability + set.with_more;
    const std::vector<int> found = groups_in(set, all.groups);
    all.more += set.with_more;
    (found.empty() ? all.others : combined[found]) += probability;
  }
  for (const auto& [numbers, probability] : combined) all.combinations.push_back({numbers, probability});
  std::stable_sort(all.combinations.begin(), all.combinations.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  return all;
}

void weigh_otherwise(Weighed& weighed, const EffectProblem& problem, const std::vector<ShownRun>& runs,
                     const Posterior& posterior) {
  for (WeighedGroup& group : weighed.groups) group.least = group.probability;
  for (const auto& [what, factors] : otherwise)
    for (const double factor : factors) {
      Assumptions assumed;
      (what == Assumed::sizes ? assumed.sizes : what == Assumed::noise ? assumed.noise : assumed.discrepancy) = factor;
      const SetEvidence evidence(problem, runs, assumed);
      const Posterior now = Sets(problem, evidence, posterior.left_out).among(posterior);
      WeighedOtherwise& told = weighed.otherwise.emplace_back(WeighedOtherwise{what, factor, now.nothing, {}});
      for (WeighedGroup& group : weighed.groups) {
        told.groups.push_back(now.of_any(group.all()));
        group.least = std::min(group.least, told.groups.back());
      }
    }
}

void foretell_moments(Weighed& weighed, const EffectProblem& problem, const std::vector<ShownRun>& runs,
                      const Posterior& posterior) {
  constexpr double even = 0.5;
  for (WeighedGroup& group : weighed.groups) {
    const std::size_t first = group.members.front();
    const auto with = std::find_if(posterior.sets.begin(), posterior.sets.end(), [&](const EffectSet& set) {
      return std::binary_search(set.members.begin(), set.members.end(), first);
    });
    if (group.probability < even || with == posterior.sets.end()) continue;
    Members without = with->members;
    std::erase(without, first);
    group.foretold = phase_gain(problem, runs, with->members, without);
    compare_moments(group, {problem, runs, posterior}, *with);
  }
}

}  // namespace tether
