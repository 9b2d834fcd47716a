#include "diagnosis/search/effect_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "diagnosis/evidence/data_errors.hpp"
#include "diagnosis/search/amplitude_interval.hpp"
#include "diagnosis/search/confirmation.hpp"
#include "diagnosis/search/contenders.hpp"
#include "diagnosis/search/judgement.hpp"
#include "diagnosis/search/phase_gain.hpp"
#include "diagnosis/search/race.hpp"
#include "diagnosis/search/shares_by_runs.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double sure = 0.95;  ///< probability of a group
constexpr double even = 0.5;   ///< probability of a group that is tried
/// What is named only at so many times the size that it may have is not what data like these look for.
constexpr double beyond_patients = 5;

class Search {
 public:
  /// evidence: where mesh and step may make wrong what effects do.
  Search(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at,
         const Weighed& weighed, const SetEvidence& evidence)
      : problem_(with_discrepancy(problem, weighed.discrepancy)),
        evidence_(evidence),
        settings_(settings),
        residual_at_(residual_at),
        race_(problem_, settings, residual_at, result_.runs),
        plain_(problem_),
        naming_(naming(problem_)),
        confirmation_(problem_) {
    const MatrixXd none(problem.residual.size(), 0);
    now_ = {VectorXd::Zero(problem.changes.cols()), problem.residual, none, none, {}};
    misfit_as_it_is_ = plain_.misfit(problem.residual);
    result_.weighed = weighed;
    result_.independent = problem.independent(problem.training).sum();
    rival_of_.resize(problem.candidates.size());
    std::iota(rival_of_.begin(), rival_of_.end(), std::size_t{0});
  }

  SearchResult run() {
    const Scores scores = plain_.scores(problem_.changes, problem_.residual);
    result_.effects = test_all(problem_, scores, result_.independent);
    for (TestedEffect& effect : result_.effects) set_detectable(effect);
    result_.before = result_.after = lack_of_fit(problem_, plain_, problem_.residual);
    while (add_one()) continue;
    if (join_two())
      while (add_one()) continue;
    try_in_place();
    result_.amplitudes = now_.amplitudes;
    result_.residual = now_.residual;
    if (now_.accepted.size() > 1)
      take_beside_each_other(result_.effects, now_, plain_.scores(now_.changes, now_.residual), result_.dispersion,
                             problem_);
    judge({problem_, settings_, plain_, now_, confirmation_, misfit_as_it_is_, rival_of_}, result_);
    share_by_runs(result_.weighed, result_.effects, problem_, result_.independent, rival_of_);
    set_groups(result_.effects, problem_, scores, result_.independent, rival_of_);
    std::stable_sort(result_.effects.begin(), result_.effects.end(), [&](const auto& a, const auto& b) {
      if (a.accepted != b.accepted) return a.accepted;
      if (a.confirmed != b.confirmed) return a.confirmed;
      return is_worth_more(a, b);
    });
    result_.cosines = cosines_of_first(result_.effects, settings_.compared, problem_, scores);
    return std::move(result_);
  }

 private:
  struct Addition {
    TestedEffect effect;
    AmplitudeState before;  ///< without it
    double best;            ///< of the misfit, with it
  };

  double worth_of(const TestedEffect& effect) const { return worth(problem_, effect, result_.independent); }
  bool is_worth_more(const TestedEffect& a, const TestedEffect& b) const { return worth_of(a) > worth_of(b); }

  void set_detectable(TestedEffect& effect) const {
    const Candidate& candidate = problem_.candidates[effect.candidate];
    const double scale = problem_.amplitudes[static_cast<std::size_t>(candidate.amplitudes.front())].scale;
    effect.visible = result_.weighed.detectable[effect.candidate];
    effect.testable = !(std::abs(effect.visible) > beyond_patients * scale);  // errors of the data have no scale
  }

  double dispersion(const VectorXd& residual) const {
    return std::max(1.0, plain_.counted_misfit(residual) / result_.independent);
  }

  /// Of those accepted, what is added to the model: errors of the data are not.
  int added() const {
    return static_cast<int>(std::count_if(now_.accepted.begin(), now_.accepted.end(),
                                          [&](std::size_t c) { return problem_.candidates[c].takes_runs(); }));
  }

  /// The most probable group that was not tried yet; null if none is as probable as not.
  const WeighedGroup* next_group() {
    for (std::size_t g = 0; g < result_.weighed.groups.size(); ++g)
      if (result_.weighed.groups[g].probability >= even && tried_.insert(g).second) return &result_.weighed.groups[g];
    return nullptr;
  }

  /// What mesh and step may make wrong in what it does at its amplitude: a column, or none.
  MatrixXd error_of(const TestedEffect& effect) const {
    const auto error = evidence_.is_scalar(effect.candidate)
                           ? evidence_.error_of(effect.candidate, effect.amplitudes(0))
                           : std::nullopt;
    return error ? MatrixXd(*error) : MatrixXd(problem_.residual.size(), 0);
  }

  /// Whether it comes as near to the misfit of what is named as a rival must: behind by what decides; and, if it
  /// explains more than that itself, by what another mesh makes wrong in it. Of that only one form is free, that of the
  /// run most alike; what is really wrong has another, and is as large.
  bool comes_near(const Refinement& one, double named) const {
    const MatrixXd error = one.effect().confirmed_gain > hopeless ? error_of(one.effect()) : MatrixXd();
    return one.best() < named + hopeless + (error.cols() > 0 ? std::expm1(plain_.cost(error.col(0))) : 0);
  }

  /// Finds the amplitudes of the strongest with runs. near: a misfit that is known, which they must come near to.
  std::vector<Refinement> refined(const std::vector<TestedEffect>& strongest, const Scores& scores,
                                  double near = infinite) {
    std::vector<Refinement> all;
    for (const TestedEffect& effect : strongest) all.emplace_back(effect, now_, error_of(effect), problem_);
    race_.run(all, scores, now_misfit(), near);
    return all;
  }
  double now_misfit() const { return plain_.misfit(now_.residual); }

  /// Probability that noise makes the gain of one of so many candidates as large, over all data that name. What those
  /// accepted before remove by other sizes of their own is no gain of this one.
  double by_chance(const TestedEffect& effect, const AmplitudeState& state, double dispersion) const {
    const double left = state.errors.cols() > now_.errors.cols()
                            ? naming_.misfit(state.residual, state.errors.rightCols(1).col(0))
                            : naming_.misfit(state.residual);
    const double before = Trained(naming(problem_), now_.changes, now_.errors).misfit(now_.residual);
    return static_cast<double>(problem_.candidates.size()) *
           chance_of(problem_, effect.candidate, (before - left) / dispersion);
  }

  /// By data that are held out, or by each moment that the others foretell; where neither can be asked it stands.
  static bool is_confirmed(const TestedEffect& effect, const WeighedGroup& group) {
    return (group.foretold && foretells(*group.foretold)) ||
           (effect.held_out ? effect.held_out->positive >= sure_gain : !group.foretold);
  }

  /// Why the data at hand and those held out do not ask for the effect; none if they do.
  std::optional<Objection> objection(const TestedEffect& effect, const AmplitudeState& state, const LackOfFit& left,
                                     const WeighedGroup& group) const {
    if (by_chance(effect, state, dispersion(state.residual)) >= settings_.alpha) return Objection::too_weak;
    const bool confirmable = problem_.candidates[effect.candidate].confirmable;
    if (confirmable && !is_confirmed(effect, group)) return Objection::not_confirmed;
    if (left.p < settings_.alpha && result_.after.excess > 0 && !(left.excess < result_.after.excess))
      return Objection::lack_of_fit_stays;
    if (effect.at_limit) return Objection::beyond_its_limit;
    return std::nullopt;
  }

  /// One step of the search; false when it is over.
  bool add_one() {
    const WeighedGroup* group = next_group();
    if (!group) return false;
    const Trained trained(problem_, now_.changes, now_.errors);
    const Scores scores = trained.scores(problem_.changes, now_.residual);
    if (added() == settings_.most) {
      const std::vector<TestedEffect> beside = test_all(problem_, scores, result_.independent);
      result_.more = group->probability >= sure && worth_of(of_candidate(beside, group->members.front())) > 0;
      return false;
    }
    const Trial trial{problem_, settings_, scores, result_.independent, now_.accepted.empty()};
    settle(refined(contenders_of(*group, trial), scores), *group);
    return true;
  }

  /// Accepts the most probable of a group that nothing speaks against, beside what is accepted already of those
  /// that explain most together with that; notes those that these data cannot tell from it. What is not of the group
  /// counts only where runs say against the table that it explains more.
  void settle(const std::vector<Refinement>& all, const WeighedGroup& group) {
    std::vector<const Refinement*> order;
    for (const Refinement& one : all)
      if (one.begun()) order.push_back(&one);
    if (!now_.accepted.empty()) put_first_what_runs_ask_for(order);
    const bool is_the_groups = explains_as_much(order, group);
    if (order.empty() && !all.empty() && all.front().runs() > 0) result_.path.push_back(broken(all.front()));
    const AmplitudeState before = now_;
    const Refinement* chosen = nullptr;
    for (const Refinement* one : order) {
      if (is_the_groups && !group.has(one->effect().candidate)) continue;
      const SearchStep& step = result_.path.emplace_back(attempt(*one, group));
      if (step.accepted()) chosen = one;
      if (step.accepted()) break;
    }
    const double spread = dispersion((chosen ? chosen->state() : before).residual);
    for (const Refinement* one : order) {
      TestedEffect effect = record_of(*one, before, spread);
      effect.accepted = one == chosen;
      const bool explains_more = chosen && one->best() < chosen->best();
      const bool may_be_it = !is_the_groups || group.has(effect.candidate) || explains_more;
      effect.rival = chosen && one != chosen && may_be_it && !was_too_weak(effect.candidate) &&
                     (before.accepted.empty() || comes_near(*one, chosen->best()));
      keep(effect, chosen ? chosen->effect().candidate : effect.candidate);
    }
    if (!chosen) return;
    keep_others_as_good(group, *chosen);
    accept(*chosen, before, spread);
    std::erase_if(tried_, [&](std::size_t g) { return may_be_beside(result_.weighed.groups[g]); });
  }

  /// What its runs showed of it, added to a model; spread: misfit per independent datum.
  TestedEffect record_of(const Refinement& one, const AmplitudeState& before, double spread) const {
    const AmplitudeState with = one.state();
    TestedEffect effect = one.effect();
    effect.run = with.amplitudes;
    effect.held_out = confirmation_.of(before.residual, with.residual);
    effect.deviations *= std::sqrt(spread);
    return effect;
  }

  /// Goes on from there. The last step of the path is this one.
  void accept(const Refinement& chosen, const AmplitudeState& before, double spread) {
    accepted_.push_back({chosen.effect(), before, chosen.best()});
    stand_at(chosen.state());
    result_.after = result_.path.back().left;
    result_.dispersion = spread;
  }

  /// Tried by itself it removed nothing, not enough, or left too much: what was accepted now was missing beside it.
  bool may_be_beside(const WeighedGroup& group) const {
    return std::none_of(result_.path.begin(), result_.path.end(), [&](const SearchStep& step) {
      return group.has(step.candidate) && step.objection != Objection::too_weak &&
             step.objection != Objection::lack_of_fit_stays;
    });
  }

  /// Members that moments do not tell from the first, of which there are more than were refined: with a run each. One
  /// that would have to do nothing stands for the others of its set alone.
  void keep_others_as_good(const WeighedGroup& group, const Refinement& chosen) {
    for (std::size_t k = 0; k < group.as_good.size(); ++k) {
      TestedEffect effect = of_candidate(result_.effects, group.members[k]);
      if (!group.as_good[k] || group.amplitudes[k] == 0 || effect.confirmed || effect.accepted) continue;
      effect.amplitudes(0) = group.amplitudes[k];
      effect.run = now_.amplitudes;
      effect.run(problem_.candidates[effect.candidate].amplitudes.front()) = group.amplitudes[k];
      if (!residual_at_(effect.run).allFinite()) continue;
      effect.rival = true;
      keep(std::move(effect), chosen.effect().candidate);
    }
  }

  /// Two of one place that look like one law, which explains about as much as both, are that law: what strong effects
  /// do is no sum, so that another came first, and what that leaves of the law second.
  bool join_two() {
    for (const std::size_t one : now_.accepted)
      for (const std::size_t other : now_.accepted) {
        if (one == other || !are_of_one_place(problem_.candidates[one], problem_.candidates[other])) continue;
        const std::vector<TestedEffect> laws = laws_for(one, other);
        if (!laws.empty() && is_joined(one, other, laws)) return true;
      }
    return false;
  }

  static bool are_of_one_place(const Candidate& one, const Candidate& other) {
    return one.takes_runs() && other.takes_runs() && one.part == other.part;
  }

  /// Rivals of one that look like another beside it as well.
  std::vector<TestedEffect> laws_for(std::size_t one, std::size_t other) const {
    std::vector<TestedEffect> laws;
    for (const TestedEffect& effect : result_.effects)
      if (effect.rival && rival_of_[effect.candidate] == one &&
          std::pow(evidence_.cosine(effect.candidate, other), 2) > look_alike)
        laws.push_back(effect);
    return laws;
  }

  AmplitudeState without(std::size_t one, std::size_t other) const {
    AmplitudeState left = now_;
    left.errors.resize(Eigen::NoChange, 0);
    left.changes.resize(Eigen::NoChange, 0);
    left.accepted.clear();
    for (std::size_t k = 0; k < now_.accepted.size(); ++k) {
      const std::size_t candidate = now_.accepted[k];
      if (candidate == one || candidate == other) {
        left.amplitudes(problem_.candidates[candidate].amplitudes).setZero();
        continue;
      }
      left.accepted.push_back(candidate);
      append_columns(left.changes, now_.changes.col(static_cast<Index>(k)));
      append_columns(left.errors, error_of(of_candidate(result_.effects, candidate)));
    }
    left.residual = residual_at_(left.amplitudes).col(0);
    return left;
  }

  bool is_joined(std::size_t one, std::size_t other, const std::vector<TestedEffect>& laws) {
    const AmplitudeState both = now_, left = without(one, other);
    if (!left.residual.allFinite()) return false;
    stand_at(left);
    const Trained trained(problem_, now_.changes, now_.errors);
    const std::vector<Refinement> all = refined(laws, trained.scores(problem_.changes, now_.residual));
    const auto law = std::min_element(all.begin(), all.end(), [](const Refinement& a, const Refinement& b) {
      return std::pair(!a.begun(), a.best()) < std::pair(!b.begun(), b.best());
    });
    if (!law->begun() || law->effect().at_limit || are_asked_for(other, both, law->state())) {
      stand_at(both);
      return false;
    }
    withdraw({one, other}, Objection::part_of_one_law);
    const AmplitudeState with = law->state();
    const LackOfFit rest = lack_of_fit(problem_, left_free(problem_, with.errors), with.residual);
    result_.path.push_back({law->effect().candidate, {}, now_misfit(), law->best(), rest});
    const double spread = dispersion(with.residual);
    for (const Refinement& each : all) {
      if (!each.begun()) continue;
      TestedEffect effect = record_of(each, left, spread);
      effect.accepted = &each == &*law;
      effect.rival = !effect.accepted && comes_near(each, law->best());
      keep(effect, law->effect().candidate);
    }
    accept(*law, left, spread);
    result_.more = false;
    std::erase_if(tried_, [&](std::size_t g) { return may_be_beside(result_.weighed.groups[g]); });
    return true;
  }

  /// Whether a second one is sure to be there, by what it removes that one law in the place of both does not.
  bool are_asked_for(std::size_t second, const AmplitudeState& both, const AmplitudeState& law) const {
    const auto misfit = [&](const AmplitudeState& state) {
      return left_free(naming(problem_), state.errors).misfit(state.residual);
    };
    TestedEffect removed = of_candidate(result_.effects, second);
    removed.confirmed_gain = (misfit(law) - misfit(both)) / dispersion(both.residual);
    const double odds_before = 1 / static_cast<double>(problem_.candidates.size());
    return std::exp(worth_of(removed) / 2) * odds_before > sure / (1 - sure);
  }

  /// Two that were accepted are so no longer, and nothing stands in their place.
  void withdraw(const std::vector<std::size_t>& candidates, Objection why) {
    const auto is_of_them = [&](std::size_t candidate) {
      return std::find(candidates.begin(), candidates.end(), candidate) != candidates.end();
    };
    for (SearchStep& step : result_.path)
      if (step.accepted() && is_of_them(step.candidate)) step.objection = why;
    std::erase_if(accepted_, [&](const Addition& addition) { return is_of_them(addition.effect.candidate); });
    for (TestedEffect& effect : result_.effects) {
      if (is_of_them(effect.candidate)) effect.accepted = effect.confirmed = false;
      if (!effect.rival || !is_of_them(rival_of_[effect.candidate])) continue;
      effect.rival = false;
      rival_of_[effect.candidate] = effect.candidate;
    }
  }

  /// What the table has beside an effect, and runs find no place for there, may do in its place: what two do is added
  /// up in the table, so that of one law's two numbers both were probable, and the one that was run first was named.
  void try_in_place() {
    if (accepted_.empty() || !problem_.candidates[accepted_.back().effect.candidate].takes_runs()) return;
    const Addition& last = accepted_.back();
    const AmplitudeState with = now_;
    std::vector<TestedEffect> rivals;
    stand_at(last.before);
    const Scores scores = Trained(problem_, now_.changes, now_.errors).scores(problem_.changes, now_.residual);
    for (const WeighedGroup& group : result_.weighed.groups) {
      if (group.probability < even || group.has(last.effect.candidate) || !has_no_place(group)) continue;
      const Trial alone{problem_, settings_, scores, result_.independent, true};
      for (const Refinement& one : refined(contenders_of(group, alone), scores, last.best))
        if (one.begun() && comes_near(one, last.best))
          rivals.push_back(record_of(one, last.before, result_.dispersion));
    }
    stand_at(with);
    for (TestedEffect& effect : rivals) {
      effect.rival = true;
      keep(std::move(effect), last.effect.candidate);
    }
  }

  /// Beside what was accepted it removed too little, or what it did was not confirmed.
  bool has_no_place(const WeighedGroup& group) const {
    return std::any_of(result_.path.begin(), result_.path.end(), [&](const SearchStep& step) {
      return group.has(step.candidate) &&
             (step.objection == Objection::too_weak || step.objection == Objection::not_confirmed);
    });
  }

  /// Goes on from there.
  void stand_at(const AmplitudeState& state) {
    now_ = state;
    plain_ = left_free(problem_, now_.errors);
    naming_ = left_free(naming(problem_), now_.errors);
  }

  /// Whether runs do not say against the table that something else than the group is wanted.
  static bool explains_as_much(const std::vector<const Refinement*>& order, const WeighedGroup& group) {
    const double best = smallest_misfit(order);
    return std::any_of(order.begin(), order.end(), [&](const auto* one) {
      return group.has(one->effect().candidate) && one->best() < best + hopeless;
    });
  }

  /// The model could not be run with any of its amplitudes.
  SearchStep broken(const Refinement& one) const {
    const double misfit = now_misfit();
    return {one.effect().candidate, Objection::breaks_down, misfit, misfit, result_.after};
  }

  /// What comes of adding it.
  SearchStep attempt(const Refinement& one, const WeighedGroup& group) const {
    const AmplitudeState state = one.state();
    TestedEffect effect = one.effect();
    effect.held_out = confirmation_.of(now_.residual, state.residual);
    const LackOfFit left = lack_of_fit(problem_, left_free(problem_, state.errors), state.residual);
    SearchStep step{effect.candidate, {}, now_misfit(), one.best(), left};
    step.objection = objection(effect, state, step.left, group);
    if (!step.objection && group.probability < sure) step.objection = Objection::not_sure;
    if (!step.objection && group.least < even) step.objection = Objection::assumed;
    return step;
  }

  bool was_too_weak(std::size_t candidate) const {
    return std::any_of(result_.path.begin(), result_.path.end(), [&](const SearchStep& step) {
      return step.candidate == candidate && step.objection == Objection::too_weak;
    });
  }

  /// What is known of an effect now; `visible` stays what it was without any other, and a rival what it was in the
  /// place of what was accepted: beside that it has nothing to do.
  void keep(TestedEffect effect, std::size_t accepted) {
    TestedEffect& kept = of_candidate(result_.effects, effect.candidate);
    if (kept.accepted || (kept.rival && !effect.accepted)) return;
    if (effect.rival) rival_of_[effect.candidate] = accepted;
    effect.visible = kept.visible;
    effect.testable = kept.testable;
    kept = std::move(effect);
  }

  static Trained left_free(const EffectProblem& problem, const MatrixXd& errors) {
    return {problem, MatrixXd(problem.residual.size(), 0), errors};
  }

  EffectProblem problem_;  ///< the model is as far off as the data say
  const SetEvidence& evidence_;
  const SearchSettings& settings_;
  const ResidualAt& residual_at_;
  SearchResult result_;
  Race race_;
  Trained plain_;
  Trained naming_;
  Confirmation confirmation_;
  AmplitudeState now_;
  std::vector<Addition> accepted_;
  double misfit_as_it_is_ = 0;
  std::vector<std::size_t> rival_of_;
  std::set<std::size_t> tried_;  ///< groups
};

}  // namespace

SearchResult search_effects(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at,
                            const Weighing& weighing, const ResidualAt& finer) {
  const auto search = [&](const Weighing& known) {
    return Search(problem, settings, residual_at, known.weighed, SetEvidence(problem, known.shown)).run();
  };
  SearchResult result = search(weighing);
  if (shows_more(result.runs, problem, weighing.shown)) {
    std::vector<ShownRun> shown = weighing.shown;
    shown.insert(shown.end(), result.runs.begin(), result.runs.end());
    const Weighing again = weigh_effects(problem, settings, {residual_at}, RunsFor::telling, std::move(shown), finer);
    std::vector<ShownRun> earlier = std::move(result.runs);
    result = search(again);
    set_intervals(result, problem, settings, again.shown);
    result.runs.insert(result.runs.begin(), earlier.begin(), earlier.end());
    return result;
  }
  set_intervals(result, problem, settings, weighing.shown);
  return result;
}

SearchResult search_effects(const EffectProblem& problem, const SearchSettings& settings,
                            const ResidualAt& residual_at) {
  return search_effects(problem, settings, residual_at, weighed_fully(problem, settings, residual_at));
}

}  // namespace tether
