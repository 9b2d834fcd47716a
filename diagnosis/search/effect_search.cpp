#include "diagnosis/search/effect_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "diagnosis/search/amplitude_interval.hpp"
#include "diagnosis/search/confirmation.hpp"
#include "diagnosis/search/judgement.hpp"
#include "diagnosis/search/phase_gain.hpp"
#include "diagnosis/search/refinement.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double sure = 0.95;       ///< probability of a group
constexpr double the_same = 0.99;   ///< cosine
constexpr std::size_t at_once = 2;  ///< candidates that are run before others know what they are up against
constexpr double even = 0.5;        ///< probability of a group that is tried
/// Share of a group's member that is named alone: 95 % though logarithms of evidence are off by 1, as between runs.
constexpr double alone = 0.98;

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
        refused_(refused_in(problem_, settings)),
        residual_at_(residual_at),
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
    try_in_place();
    result_.amplitudes = now_.amplitudes;
    result_.residual = now_.residual;
    refit_accepted();
    judge({problem_, settings_, plain_, now_, confirmation_, misfit_as_it_is_, rival_of_}, result_);
    set_groups(result_.effects, problem_, scores, result_.independent, rival_of_);
    std::stable_sort(result_.effects.begin(), result_.effects.end(), [&](const auto& a, const auto& b) {
      if (a.accepted != b.accepted) return a.accepted;
      if (a.confirmed != b.confirmed) return a.confirmed;
      return is_worth_more(a, b);
    });
    compare_strongest(scores);
    return std::move(result_);
  }

 private:
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
  bool is_accepted(std::size_t candidate) const {
    return std::find(now_.accepted.begin(), now_.accepted.end(), candidate) != now_.accepted.end();
  }

  /// The most probable group that was not tried yet; null if none is as probable as not.
  const WeighedGroup* next_group() {
    for (std::size_t g = 0; g < result_.weighed.groups.size(); ++g)
      if (result_.weighed.groups[g].probability >= even && tried_.insert(g).second) return &result_.weighed.groups[g];
    return nullptr;
  }

  /// Its members that may be it, at their most probable amplitudes. Beside what is accepted already all of them, and
  /// all that look like the first: their shares are of what each does alone, runs of both together decide.
  std::vector<TestedEffect> likely_of(const WeighedGroup& group, const Trained& trained) const {
    const Scores scores = trained.scores(problem_.changes, now_.residual);
    const std::vector<TestedEffect> tested = test_all(problem_, scores, result_.independent);
    std::vector<TestedEffect> all;
    for (std::size_t k = 0; k < group.members.size() && static_cast<int>(all.size()) < settings_.confirmed; ++k) {
      const bool as_good = k < group.as_good.size() && group.as_good[k];
      if (k > 0 && group.shares.front() >= alone && now_.accepted.empty() && !as_good) continue;
      TestedEffect& effect = all.emplace_back(*std::find_if(
          tested.begin(), tested.end(), [&](const TestedEffect& e) { return e.candidate == group.members[k]; }));
      if (std::isfinite(group.amplitudes[k])) effect.amplitudes(0) = group.amplitudes[k];
    }
    if (!now_.accepted.empty()) add_in_its_place(all, group, tested, scores);
    return all;
  }

  void add_in_its_place(std::vector<TestedEffect>& all, const WeighedGroup& group, std::vector<TestedEffect> tested,
                        const Scores& scores) const {
    const TestedEffect first = *std::find_if(
        tested.begin(), tested.end(), [&](const TestedEffect& e) { return e.candidate == group.members.front(); });
    std::stable_sort(tested.begin(), tested.end(), [](const auto& a, const auto& b) { return a.gain > b.gain; });
    for (const TestedEffect& other : tested) {
      const bool may_be_it =
          other.gain > tested.front().gain / 2 || std::pow(cosine(problem_, scores, first, other), 2) > look_alike;
      if (may_be_it && static_cast<int>(all.size()) < settings_.confirmed && !group.has(other.candidate) &&
          !refused_[other.candidate] && problem_.candidates[other.candidate].takes_runs())
        all.push_back(other);
    }
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

  /// Finds the amplitudes of the strongest with runs, always of those that promise most; the hopeless are not run.
  std::vector<Refinement> refined(const std::vector<TestedEffect>& strongest, const Trained& trained) {
    std::vector<Refinement> all;
    for (const TestedEffect& effect : strongest) all.emplace_back(effect, now_, error_of(effect), problem_);
    const Scores scores = trained.scores(problem_.changes, now_.residual);
    while (true) {
      std::vector<Refinement*> open;
      for (Refinement& one : all)
        if (!one.done() && one.runs() < settings_.refinements) open.push_back(&one);
      if (open.empty()) return all;
      std::stable_sort(open.begin(), open.end(), [](const auto* a, const auto* b) { return a->hope() < b->hope(); });
      if (open.size() > at_once) open.resize(at_once);
      run(open);
      learn_from_look_alikes(all, scores);
      give_up_hopeless(all);
    }
  }

  void run(const std::vector<Refinement*>& open) {
    MatrixXd wanted(problem_.changes.cols(), static_cast<Index>(open.size()));
    for (std::size_t i = 0; i < open.size(); ++i) wanted.col(static_cast<Index>(i)) = open[i]->amplitudes();
    const MatrixXd residuals = residual_at_(wanted);
    for (std::size_t i = 0; i < open.size(); ++i) {
      const auto k = static_cast<Index>(i);
      open[i]->take(residuals.col(k));
      result_.runs.push_back({wanted.col(k), residuals.col(k)});
    }
  }

  /// What does the same to first order saturates alike.
  void learn_from_look_alikes(std::vector<Refinement>& all, const Scores& scores) const {
    for (Refinement& one : all)
      for (const Refinement& other : all)
        if (!one.begun() && other.begun() &&
            std::abs(cosine(problem_, scores, one.effect(), other.effect())) > the_same)
          one.expect_at_most(now_misfit() - std::min(other.best(), other.hope()));
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
    if (added() == settings_.most) {
      result_.more = group->probability >= sure;
      return false;
    }
    const Trained trained(problem_, now_.changes, now_.errors);
    settle(refined(likely_of(*group, trained), trained), *group);
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
      TestedEffect effect = one->effect();
      effect.run = one->state().amplitudes;
      effect.held_out = confirmation_.of(before.residual, one->state().residual);
      effect.deviations *= std::sqrt(spread);
      effect.accepted = one == chosen;
      const bool explains_more = chosen && one->best() < chosen->best();
      const bool may_be_it = !is_the_groups || group.has(effect.candidate) || explains_more;
      effect.rival = chosen && one != chosen && may_be_it && !was_too_weak(effect.candidate) &&
                     (before.accepted.empty() || comes_near(*one, chosen->best()));
      if (effect.rival) rival_of_[effect.candidate] = chosen->effect().candidate;
      keep(effect);
    }
    if (!chosen) return;
    keep_others_as_good(group, *chosen);
    accepted_.push_back({chosen->effect(), before, chosen->best()});
    now_ = chosen->state();
    plain_ = left_free(problem_, now_.errors);
    naming_ = left_free(naming(problem_), now_.errors);
    result_.after = result_.path.back().left;
    result_.dispersion = spread;
    std::erase_if(tried_, [&](std::size_t g) { return may_be_beside(result_.weighed.groups[g]); });
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
      TestedEffect effect = *std::find_if(result_.effects.begin(), result_.effects.end(),
                                          [&](const TestedEffect& e) { return e.candidate == group.members[k]; });
      if (!group.as_good[k] || group.amplitudes[k] == 0 || effect.confirmed || effect.accepted) continue;
      effect.amplitudes(0) = group.amplitudes[k];
      effect.run = now_.amplitudes;
      effect.run(problem_.candidates[effect.candidate].amplitudes.front()) = group.amplitudes[k];
      if (!residual_at_(effect.run).allFinite()) continue;
      effect.rival = true;
      rival_of_[effect.candidate] = chosen.effect().candidate;
      keep(std::move(effect));
    }
  }

  /// What the table has beside an effect, and runs find nothing left for there, may do in its place: what two do is
  /// added up in the table, so that of one law's two numbers both were probable, and the one that was run first was
  /// named.
  void try_in_place() {
    if (accepted_.empty() || !problem_.candidates[accepted_.back().effect.candidate].takes_runs()) return;
    const Addition& last = accepted_.back();
    const Trained trained(problem_, last.before.changes, last.before.errors);
    const std::vector<TestedEffect> tested =
        test_all(problem_, trained.scores(problem_.changes, last.before.residual), result_.independent);
    for (const WeighedGroup& group : result_.weighed.groups) {
      const std::size_t candidate = group.members.front();
      if (group.probability < even || group.has(last.effect.candidate) || !was_too_weak(candidate)) continue;
      TestedEffect effect =
          *std::find_if(tested.begin(), tested.end(), [&](const TestedEffect& e) { return e.candidate == candidate; });
      if (std::isfinite(group.amplitudes.front())) effect.amplitudes(0) = group.amplitudes.front();
      std::vector<Refinement> alone;
      alone.emplace_back(effect, last.before, error_of(effect), problem_);
      Refinement& one = alone.front();
      while (!one.done() && one.runs() < settings_.refinements && one.hope() < last.best + hopeless) run({&one});
      if (!one.begun() || !comes_near(one, last.best)) continue;
      effect = one.effect();
      effect.run = one.state().amplitudes;
      effect.held_out = confirmation_.of(last.before.residual, one.state().residual);
      effect.deviations *= std::sqrt(result_.dispersion);
      effect.rival = true;
      rival_of_[candidate] = last.effect.candidate;
      keep(std::move(effect));
    }
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

  /// What is known of an effect now; `visible` stays what it was without any other.
  void keep(TestedEffect effect) {
    TestedEffect& kept = *std::find_if(result_.effects.begin(), result_.effects.end(),
                                       [&](const TestedEffect& e) { return e.candidate == effect.candidate; });
    if (kept.accepted) return;
    effect.visible = kept.visible;
    effect.testable = kept.testable;
    effect.rival = !effect.accepted && (effect.rival || kept.rival);
    kept = std::move(effect);
  }

  /// Amplitudes and deviations of those accepted first, as they are beside the later ones.
  void refit_accepted() {
    if (now_.accepted.size() < 2) return;
    const MatrixXd covariance = plain_.scores(now_.changes, now_.residual).information.inverse();
    for (std::size_t k = 0; k < now_.accepted.size(); ++k) {
      const auto number = static_cast<Index>(k);
      for (TestedEffect& effect : result_.effects)
        if (effect.candidate == now_.accepted[k]) {
          effect.amplitudes = now_.amplitudes(problem_.candidates[effect.candidate].amplitudes);
          effect.beside = true;
          const VectorXd in_proportion =
              effect.amplitudes.cwiseAbs() * std::sqrt(covariance(number, number) * result_.dispersion);
          effect.deviations = in_proportion.size() == 1 ? in_proportion : in_proportion.cwiseMax(effect.deviations);
        }
    }
  }

  void compare_strongest(const Scores& scores) {
    const auto count = std::min<Index>(settings_.compared, static_cast<Index>(result_.effects.size()));
    result_.cosines.resize(count, count);
    for (Index i = 0; i < count; ++i)
      for (Index j = 0; j < count; ++j)
        result_.cosines(i, j) = cosine(problem_, scores, result_.effects[static_cast<std::size_t>(i)],
                                       result_.effects[static_cast<std::size_t>(j)]);
  }

  static Trained left_free(const EffectProblem& problem, const MatrixXd& errors) {
    return {problem, MatrixXd(problem.residual.size(), 0), errors};
  }

  struct Addition {
    TestedEffect effect;
    AmplitudeState before;  ///< without it
    double best;            ///< of the misfit, with it
  };

  EffectProblem problem_;  ///< the model is as far off as the data say
  const SetEvidence& evidence_;
  const SearchSettings& settings_;
  std::vector<bool> refused_;
  const ResidualAt& residual_at_;
  Trained plain_;
  Trained naming_;
  Confirmation confirmation_;
  AmplitudeState now_;
  std::vector<Addition> accepted_;
  double misfit_as_it_is_ = 0;
  SearchResult result_;
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
