#include "diagnosis/effect_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/chances.hpp"
#include "diagnosis/statistics.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr double convincing = 6;  ///< of BIC
constexpr double hopeless = 30;   ///< of the misfit, behind the best

/// The training part of a problem, with what is allowed and what was accepted taken out.
class Trained {
 public:
  Trained(const EffectProblem& problem, const std::vector<Index>& accepted)
      : rows_(problem.training),
        allowed_(precision_of(problem), columns_of(problem, accepted), deviations_of(problem, accepted)) {}

  VectorXd rows(const VectorXd& all) const { return all(rows_); }
  MatrixXd rows(const MatrixXd& all) const { return all(rows_, Eigen::all); }
  const AllowedErrors& allowed() const { return allowed_; }
  double misfit(const VectorXd& residual) const {
    const VectorXd r = rows(residual);
    return r.dot(allowed_(r).col(0));
  }

 private:
  static VectorXd precision_of(const EffectProblem& problem) { return problem.precision(problem.training); }
  static MatrixXd columns_of(const EffectProblem& problem, const std::vector<Index>& accepted) {
    MatrixXd columns(problem.training.size(), problem.allowed.cols() + static_cast<Index>(accepted.size()));
    columns << problem.allowed(problem.training, Eigen::all), problem.changes(problem.training, accepted);
    return columns;
  }
  static VectorXd deviations_of(const EffectProblem& problem, const std::vector<Index>& accepted) {
    VectorXd deviations(problem.allowed.cols() + static_cast<Index>(accepted.size()));
    deviations << problem.allowed_deviation, VectorXd::Constant(static_cast<Index>(accepted.size()), infinite);
    return deviations;
  }

  std::vector<Index> rows_;
  AllowedErrors allowed_;
};

std::vector<bool> sides(const EffectProblem& problem, const std::vector<Index>& of) {
  std::vector<bool> one_sided;
  for (const Index i : of) one_sided.push_back(problem.amplitudes[static_cast<std::size_t>(i)].one_sided);
  return one_sided;
}

/// z of the same probability, for people.
double as_z(double p) {
  return p > 1e-300 ? -normal_quantile(std::max(p, 1e-300)) : 37;
}

double probability(const Fit& fit, const std::vector<bool>& one_sided) {
  const int n = static_cast<int>(one_sided.size());
  const bool any = std::any_of(one_sided.begin(), one_sided.end(), [](bool one) { return one; });
  return any ? one_sided_tail(fit.gain, n) : chi_square_tail(fit.gain, n);  // (D.10)
}

TestedEffect test(const EffectProblem& problem, std::size_t number, const Scores& scores) {
  const std::vector<Index>& own = problem.candidates[number].amplitudes;
  const MatrixXd information = scores.information(own, own);
  const std::vector<bool> one_sided = sides(problem, own);
  const Fit fit = best_fit(information, scores.response(own), one_sided);
  TestedEffect effect;
  effect.candidate = number;
  effect.gain = fit.gain;
  effect.p = probability(fit, one_sided);
  effect.z = fit.gain > 0 ? (own.size() == 1 ? std::sqrt(fit.gain) : as_z(effect.p)) : 0;
  if (own.size() == 1 && scores.response(own[0]) < 0)
    effect.z = -std::sqrt(scores.response(own[0]) * scores.response(own[0]) / information(0, 0));
  effect.amplitudes = fit.amplitudes;
  effect.deviations = information.diagonal().cwiseMax(1e-300).cwiseInverse().cwiseSqrt();
  const double alone = scores.alone(own).sum();
  effect.retained = alone > 0 ? information.trace() / alone : 0;
  return effect;
}

/// Of the model's changes for two effects, each at its best amplitudes.
double cosine(const EffectProblem& problem, const Scores& scores, const TestedEffect& a, const TestedEffect& b) {
  const auto direction = [&](const TestedEffect& effect) {
    VectorXd all = VectorXd::Zero(problem.changes.cols());
    const auto& own = problem.candidates[effect.candidate].amplitudes;
    if (effect.amplitudes.squaredNorm() > 0)
      all(own) = effect.amplitudes;
    else
      all(own[0]) = 1;
    return all;
  };
  const VectorXd u = direction(a), v = direction(b);
  const double size = u.dot(scores.information * u) * v.dot(scores.information * v);
  return size > 0 ? u.dot(scores.information * v) / std::sqrt(size) : 0;
}

/// Evidence less what so many amplitudes cost (BIC).
double worth(const EffectProblem& problem, const TestedEffect& effect, double count) {
  const double gain = effect.confirmed ? effect.confirmed_gain : effect.gain;
  return gain - static_cast<double>(problem.candidates[effect.candidate].amplitudes.size()) * std::log(count);
}

/// (D.11)
LackOfFit lack_of_fit(const EffectProblem& problem, const Trained& trained, const VectorXd& residual) {
  LackOfFit lack;
  if (problem.patterns.cols() == 0) return lack;
  const Scores scores = scores_of(trained.allowed(), trained.rows(problem.patterns), trained.rows(residual));
  double smallest = 1;
  int seen = 0;
  for (Index k = 0; k < scores.response.size(); ++k) {
    if (!(scores.information(k, k) > 1e-9 * scores.alone(k)) || scores.alone(k) == 0) continue;
    ++seen;
    const double z = scores.response(k) / std::sqrt(scores.information(k, k));
    const bool is_moment = problem.pattern_names[static_cast<std::size_t>(k)].time ==
                           problem.pattern_names[static_cast<std::size_t>(k)].time;
    if (is_moment) lack.excess += z * z - 1;
    if (const double p = 2 * normal_tail(std::abs(z)); p < smallest) {
      smallest = p;
      lack.worst = static_cast<std::size_t>(k);
      lack.z = z;
    }
  }
  lack.p = std::min(1.0, seen * smallest);
  lack.excess = std::max(0.0, lack.excess);
  return lack;
}

/// An effect on its way to the amplitude with the smallest misfit: its amplitudes to first order times a factor. (D.10)
class Refined {
 public:
  Refined(TestedEffect& effect, VectorXd others, VectorXd residual, const Trained& trained,
          const EffectProblem& problem)
      : effect_(effect),
        others_(std::move(others)),
        trained_(trained),
        problem_(problem),
        last_(trained.rows(residual)) {
    start_ = best_ = misfit(last_);
    residual_ = std::move(residual);
  }
  bool done() const { return done_; }
  VectorXd amplitudes() const { return at(next_); }
  /// The run at `amplitudes` came back: the next is where the misfit is least, as the last two runs have it; in the
  /// logarithm of the factor from the second run on.
  void take(const VectorXd& residual) {
    const VectorXd now = trained_.rows(residual);
    const bool first = factor_ == 0;
    const VectorXd change = (last_ - now) / (first ? next_ : std::log(next_ / factor_));
    const VectorXd weighted = trained_.allowed()(change).col(0);
    const double information = weighted.dot(change), step = weighted.dot(now) / information;
    factor_ = next_;
    last_ = now;
    if (const double found = misfit(now); found < best_) {
      best_ = found;
      residual_ = residual;
      effect_.amplitudes = at(factor_)(own()) - others_(own());
    }
    effect_.deviations = effect_.amplitudes.cwiseAbs() / (std::sqrt(information) * (first ? factor_ : 1));
    effect_.confirmed_gain = start_ - best_;
    next_ =
        first ? std::clamp(factor_ + step, factor_ / 4, 4 * factor_) : factor_ * std::exp(std::clamp(step, -1.4, 1.4));
    expected_ = step * step * information;
    done_ = !(expected_ >= 0.25);  // also if the run changed nothing
  }
  /// Not even twice the gain that the last two runs promise would bring it near the best.
  void give_up_behind(double best) { done_ = done_ || best_ - 2 * expected_ > best + hopeless; }
  double best() const { return best_; }
  const VectorXd& residual() const { return residual_; }
  VectorXd total() const {
    VectorXd all = others_;
    all(own()) += effect_.amplitudes;
    return all;
  }

 private:
  const std::vector<Index>& own() const { return problem_.candidates[effect_.candidate].amplitudes; }
  VectorXd at(double factor) const {
    VectorXd all = others_;
    all(own()) += factor * direction_;
    return all;
  }
  double misfit(const VectorXd& r) const { return r.dot(trained_.allowed()(r).col(0)); }

  TestedEffect& effect_;
  VectorXd others_;
  const Trained& trained_;
  const EffectProblem& problem_;
  VectorXd last_, residual_, direction_ = effect_.amplitudes;
  double start_ = 0, best_ = 0, factor_ = 0, next_ = 1, expected_ = infinite;
  bool done_ = false;
};

class Search {
 public:
  Search(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at)
      : problem_(problem), settings_(settings), residual_at_(residual_at), plain_(problem, {}) {
    result_.amplitudes = VectorXd::Zero(problem.changes.cols());
    result_.residual = problem.residual;
    result_.independent = problem.independent(problem.training).sum();
  }

  SearchResult run() {
    const Scores scores = scores_now(plain_);
    result_.effects = tested(scores);
    for (TestedEffect& effect : result_.effects) effect.visible = visible(scores, effect);
    result_.before = result_.after = lack_of_fit(problem_, plain_, problem_.residual);
    while (static_cast<int>(result_.path.size()) < settings_.most && add_one()) continue;
    judge();
    set_groups(scores);
    std::stable_sort(result_.effects.begin(), result_.effects.end(), [&](const auto& a, const auto& b) {
      if (a.accepted != b.accepted) return a.accepted;
      if (a.confirmed != b.confirmed) return a.confirmed;
      return worth(problem_, a, result_.independent) > worth(problem_, b, result_.independent);
    });
    compare_strongest(scores);
    return std::move(result_);
  }

 private:
  Scores scores_now(const Trained& trained) const {
    return scores_of(trained.allowed(), trained.rows(problem_.changes), trained.rows(result_.residual));
  }

  std::vector<TestedEffect> tested(const Scores& scores) const {
    std::vector<TestedEffect> all;
    std::vector<double> p;
    for (std::size_t i = 0; i < problem_.candidates.size(); ++i) {
      all.push_back(test(problem_, i, scores));
      p.push_back(all.back().p);
    }
    const std::vector<double> q = holm(p);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].q = q[i];
    return all;
  }

  /// (D.12)
  double visible(const Scores& scores, const TestedEffect& effect) const {
    const Index first = problem_.candidates[effect.candidate].amplitudes.front();
    const bool one_sided = problem_.amplitudes[static_cast<std::size_t>(first)].one_sided;
    const double tests = static_cast<double>(problem_.candidates.size()) * (one_sided ? 1 : 2);
    const double information = scores.information(first, first);
    return information > 0 ? (normal_quantile(1 - settings_.alpha / tests) + 0.842) / std::sqrt(information) : infinite;
  }

  double dispersion(const VectorXd& residual) const {
    const VectorXd r = residual(problem_.training), w = problem_.precision(problem_.training);
    return std::max(1.0, r.dot(w.cwiseProduct(r)) / result_.independent);
  }

  bool was_tried(std::size_t candidate) const {
    return std::any_of(result_.path.begin(), result_.path.end(),
                       [&](const SearchStep& step) { return step.candidate == candidate; });
  }

  std::vector<Index> accepted_amplitudes() const {
    std::vector<Index> all;
    for (const SearchStep& step : result_.path)
      if (step.accepted)
        for (const Index i : problem_.candidates[step.candidate].amplitudes) all.push_back(i);
    return all;
  }

  /// Finds the amplitudes of the strongest with runs, side by side.
  std::vector<Refined> refine(std::vector<TestedEffect>& strongest) const {
    std::vector<Refined> all;
    all.reserve(strongest.size());
    for (TestedEffect& effect : strongest)
      all.emplace_back(effect, result_.amplitudes, result_.residual, plain_, problem_);
    for (int round = 0; round < settings_.refinements; ++round) {
      std::vector<Refined*> open;
      for (Refined& one : all)
        if (!one.done()) open.push_back(&one);
      if (open.empty()) break;
      MatrixXd wanted(problem_.changes.cols(), static_cast<Index>(open.size()));
      for (std::size_t i = 0; i < open.size(); ++i) wanted.col(static_cast<Index>(i)) = open[i]->amplitudes();
      const MatrixXd residuals = residual_at_(wanted);
      for (std::size_t i = 0; i < open.size(); ++i) open[i]->take(residuals.col(static_cast<Index>(i)));
      if (round > 0) give_up(all);
    }
    for (TestedEffect& effect : strongest) effect.confirmed = true;
    return all;
  }

  static void give_up(std::vector<Refined>& all) {
    double best = infinite;
    for (const Refined& one : all) best = std::min(best, one.best());
    for (Refined& one : all) one.give_up_behind(best);
  }

  std::optional<Gain> held_out_gain(const VectorXd& before, const VectorXd& after) const {
    if (problem_.held_out.size() < 2) return std::nullopt;
    std::vector<int> block;
    for (const Index i : problem_.held_out) block.push_back(problem_.block[static_cast<std::size_t>(i)]);
    return gain_of(problem_.precision(problem_.held_out), block, before(problem_.held_out), after(problem_.held_out),
                   problem_.independent(problem_.held_out).sum());
  }

  /// Whether the data at hand and those held out ask for the effect; else why not.
  std::string objection(const TestedEffect& effect, double dispersion, const LackOfFit& left) const {
    if (worth(problem_, effect, result_.independent) < convincing * dispersion)
      return "the misfit does not fall by enough";
    const bool confirmable = problem_.candidates[effect.candidate].confirmable;
    if (confirmable && effect.held_out && !(effect.held_out->lower > 0)) return "held-out data do not confirm it";
    if (result_.after.excess > 0 && !(left.excess < result_.after.excess)) return "the lack of fit does not fall";
    return {};
  }

  /// One step of the search; false when it is over.
  bool add_one() {
    const Trained trained(problem_, accepted_amplitudes());
    std::vector<TestedEffect> strongest = tested(scores_now(trained));
    std::erase_if(strongest, [&](const TestedEffect& e) { return e.q >= settings_.alpha || was_tried(e.candidate); });
    if (strongest.empty()) return false;
    const auto by_worth = [&](const TestedEffect& a, const TestedEffect& b) {
      return worth(problem_, a, result_.independent) > worth(problem_, b, result_.independent);
    };
    std::sort(strongest.begin(), strongest.end(), by_worth);
    std::erase_if(strongest, [most = strongest.front().gain](const TestedEffect& e) { return e.gain < 0.6 * most; });
    if (static_cast<int>(strongest.size()) > settings_.confirmed)
      strongest.resize(static_cast<std::size_t>(settings_.confirmed));
    const std::vector<Refined> refined = refine(strongest);
    const auto best =
        static_cast<std::size_t>(std::min_element(strongest.begin(), strongest.end(), by_worth) - strongest.begin());
    return settle(strongest, best, refined);
  }

  /// Accepts the best or says why not; notes those that these data cannot tell from it.
  bool settle(std::vector<TestedEffect>& strongest, std::size_t best, const std::vector<Refined>& refined) {
    const VectorXd& residual = refined[best].residual();
    const double spread = dispersion(residual);
    for (std::size_t i = 0; i < strongest.size(); ++i) {
      strongest[i].deviations *= std::sqrt(spread);
      strongest[i].held_out = held_out_gain(result_.residual, refined[i].residual());
    }
    SearchStep step{strongest[best].candidate,
                    false,
                    {},
                    plain_.misfit(result_.residual),
                    plain_.misfit(residual),
                    lack_of_fit(problem_, plain_, residual)};
    step.reason = objection(strongest[best], spread, step.left);
    step.accepted = strongest[best].accepted = step.reason.empty();
    result_.path.push_back(step);
    const double most = worth(problem_, strongest[best], result_.independent);
    for (const TestedEffect& effect : strongest) {
      TestedEffect& kept = *std::find_if(result_.effects.begin(), result_.effects.end(),
                                         [&](const TestedEffect& e) { return e.candidate == effect.candidate; });
      if (kept.accepted) continue;
      const double visible = kept.visible;
      kept = effect;
      kept.visible = visible;
      if (step.accepted && &effect != &strongest[best] &&
          worth(problem_, effect, result_.independent) > most - convincing * spread)
        rivals_.push_back(effect.candidate);
    }
    if (!step.accepted) return false;
    result_.amplitudes = refined[best].total();
    result_.residual = residual;
    result_.after = step.left;
    result_.dispersion = spread;
    return rivals_.empty() && leaves_too_much();
  }

  bool leaves_too_much() const {
    return result_.after.p < settings_.alpha && result_.after.excess > settings_.unexplained * result_.before.excess;
  }

  void judge() {
    const bool accepted = result_.amplitudes.squaredNorm() > 0;
    if (accepted) result_.held_out = held_out_gain(problem_.residual, result_.residual);
    if (leaves_too_much())
      result_.verdict = "not_in_catalogue";
    else if (!rivals_.empty())
      result_.verdict = "ambiguous";
    else if (accepted)
      result_.verdict = "missing";
    else if (!result_.path.empty() || !sees_anything())
      result_.verdict = "undecided";
    else
      result_.verdict = "nothing_missing";
  }

  /// Whether any effect would be seen at the size that it may have in a patient.
  bool sees_anything() const {
    return std::any_of(result_.effects.begin(), result_.effects.end(), [&](const TestedEffect& effect) {
      const Candidate& candidate = problem_.candidates[effect.candidate];
      const double scale = problem_.amplitudes[static_cast<std::size_t>(candidate.amplitudes.front())].scale;
      return candidate.kind == Candidate::Kind::effect && effect.visible < scale;
    });
  }

  /// By their evidence, each with those that look like it; rivals with what they rival.
  void set_groups(const Scores& scores) {
    std::vector<TestedEffect*> order;
    for (TestedEffect& effect : result_.effects) order.push_back(&effect);
    std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) {
      if (a->accepted != b->accepted) return a->accepted;
      return worth(problem_, *a, result_.independent) > worth(problem_, *b, result_.independent);
    });
    int groups = 0;
    for (TestedEffect* first : order) {
      if (first->group >= 0) continue;
      bool any = false;
      for (TestedEffect* other : order) {
        if (other == first || other->group >= 0) continue;
        const double c = cosine(problem_, scores, *first, *other);
        const bool rival = groups == 0 && std::find(rivals_.begin(), rivals_.end(), other->candidate) != rivals_.end();
        if (!rival && std::abs(c) <= 0.9) continue;
        other->group = groups;
        other->cosine = c;
        any = true;
      }
      if (!any) continue;
      first->group = groups++;
      first->cosine = 1;
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

  const EffectProblem& problem_;
  const SearchSettings& settings_;
  const ResidualAt& residual_at_;
  Trained plain_;
  SearchResult result_;
  std::vector<std::size_t> rivals_;
};

}  // namespace

SearchResult search_effects(const EffectProblem& problem, const SearchSettings& settings,
                            const ResidualAt& residual_at) {
  return Search(problem, settings, residual_at).run();
}

}  // namespace tether
