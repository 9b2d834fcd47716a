#include "diagnosis/search/refinement.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double larger = 2.5;     ///< gain at the right amplitude over that of first order: 2.3 was seen (decision 90)
constexpr double too_little = 1;   ///< of the misfit, to run once more
constexpr double saturated = 0.5;  ///< of what first order says: its tangent there is not known from one run
constexpr double aside = 0.4;      ///< logarithm by which another run tells the tangent
constexpr double farthest = 0.7;   ///< logarithm by which an accepted effect's factor moves at most in a step

double square(const Trained& trained, const VectorXd& all) {
  return trained.misfit(all);
}

double product(const Trained& trained, const VectorXd& a, const VectorXd& b) {
  return trained.rows(a).dot(trained.allowed()(trained.rows(b)).col(0));
}

MatrixXd none_of(const MatrixXd& columns) {
  return {columns.rows(), 0};
}

MatrixXd beside(const MatrixXd& some, const MatrixXd& more) {
  MatrixXd all(some.rows(), some.cols() + more.cols());
  all << some, more;
  return all;
}

}  // namespace

Refinement::Refinement(TestedEffect effect, const AmplitudeState& from, const MatrixXd& error,
                       const EffectProblem& problem)
    : effect_(std::move(effect)),
      from_(from),
      problem_(problem),
      errors_(beside(from.errors, error)),
      trained_(problem, from.changes, errors_),
      plain_(problem, none_of(from.errors), errors_) {
  const Trained before(problem, none_of(from.errors), from.errors);
  if (error.cols() > 0) cost_ = before.cost(error.col(0));
  direction_ = VectorXd::Zero(problem.changes.cols());
  direction_(own(effect_.candidate)) = effect_.amplitudes;
  first_order_ = problem.changes * direction_;
  residual_ = best_residual_ = from.residual;
  start_ = best_ = before.misfit(from.residual);
  expected_ = effect_.gain;
  others_ = best_others_ = VectorXd::Zero(from.changes.cols());
  next_others_ = others_for(from.residual - first_order_);
  for (const Eigen::Index i : own(effect_.candidate))
    if (const double d = direction_(i); d != 0)
      farthest_ =
          std::min(farthest_, problem.amplitudes[static_cast<std::size_t>(i)].limited(std::copysign(infinite, d)) / d);
  next_ = std::min(1.0, farthest_);
  done_ = !(farthest_ > 0);
}

VectorXd Refinement::at(double factor, const VectorXd& others) const {
  VectorXd all = from_.amplitudes;
  for (std::size_t k = 0; k < from_.accepted.size(); ++k)
    all(own(from_.accepted[k])) *= std::exp(others(static_cast<Eigen::Index>(k)));
  return all + factor * direction_;
}

VectorXd Refinement::others_for(const VectorXd& residual) const {
  if (from_.changes.cols() == 0) return VectorXd(0);
  const Scores scores = plain_.scores(from_.changes, residual);
  const VectorXd shift = scores.information.ldlt().solve(scores.response);
  return shift.cwiseMax(-farthest).cwiseMin(farthest);
}

/// After one run: what the effect does follows its first order in t = f/(1 + c f), which saturates, and departs from
/// it by the square of t; both are known from this run. The factor where the misfit is least.
double Refinement::first_step(const VectorXd& change, const VectorXd& now) {
  const double along = product(trained_, first_order_, change) / square(trained_, first_order_);
  per_factor_ = change;
  if (!(along > 0.05)) return later_step(now);
  const double t = along * last_, c = (last_ / t - 1) / last_;
  bends_ = c;
  const VectorXd bend = (change - t * first_order_) / (t * t);
  const double ss = square(trained_, first_order_), sb = product(trained_, first_order_, bend),
               bb = square(trained_, bend), rs = product(trained_, from_.residual, first_order_),
               rb = product(trained_, from_.residual, bend);
  const auto misfit = [&](double f) {
    const double x = f / (1 + c * f), y = x * x;
    return -2 * x * rs - 2 * y * rb + x * x * ss + 2 * x * y * sb + y * y * bb;
  };
  double best = last_;
  for (int k = -80; k <= 80; ++k) {  // a factor of 8 either way
    const double f = last_ * std::exp(k * 0.026);
    if (1 + c * f > 0.1 && misfit(f) < misfit(best)) best = f;
  }
  expected_ = misfit(last_) - misfit(best);
  const double x = best / (1 + c * best);
  per_factor_ = (first_order_ + 2 * x * bend) * (x * x / best);
  if (along > saturated || std::abs(std::log(best / last_)) > aside) return best;
  expected_ = std::max(expected_, too_little);
  return last_ * std::exp(best > last_ ? aside : -aside);
}

double Refinement::later_step(const VectorXd& now) {
  const double information = square(trained_, per_factor_), step = product(trained_, per_factor_, now) / information;
  expected_ = step * step * information;
  return last_ * std::exp(std::clamp(step, -1.4, 1.4));
}

/// The model broke down with these amplitudes: nearer to where it did not.
void Refinement::retreat() {
  next_ = begun() ? std::sqrt(next_ * last_) : next_ / 2;
  next_others_ = (next_others_ + others_) / 2;
  done_ = ++failures_ > 3;
}

void Refinement::take(const VectorXd& residual) {
  ++runs_;
  if (!residual.allFinite()) return retreat();
  const bool first = !begun();
  const VectorXd shift = next_others_ - others_;
  const VectorXd own_change = residual_ - residual - from_.changes * shift;
  const double before = last_;
  last_ = next_;
  others_ = next_others_;
  residual_ = residual;
  if (const double found = plain_.misfit(residual) + cost_; found < best_) {
    best_ = found;
    best_factor_ = last_;
    best_others_ = others_;
    best_residual_ = residual;
  }
  if (first) {
    next_ = first_step(own_change, residual);
  } else {
    if (const double way = std::log(last_ / before); std::abs(way) > 0.02) per_factor_ = own_change / way;
    next_ = later_step(residual);
  }
  next_ = std::min(next_, farthest_);
  if (next_ == last_) expected_ = 0;
  const double information = square(trained_, per_factor_);
  done_ = !(expected_ >= too_little);  // also if the run changed nothing
  const double factor = done_ && best_factor_ == last_ ? next_ : best_factor_;
  effect_.amplitudes = factor * direction_(own(effect_.candidate));
  effect_.at_limit = factor > 0.99 * farthest_;
  effect_.saturation = bends_ * factor;
  const VectorXd in_proportion = effect_.amplitudes.cwiseAbs() / std::sqrt(std::max(information, 1e-300));
  effect_.deviations = in_proportion.size() == 1 ? in_proportion : in_proportion.cwiseMax(effect_.deviations);
  effect_.confirmed = true;
  effect_.confirmed_gain = start_ - best_;
  const VectorXd left = residual - per_factor_ * std::log(next_ / last_);
  next_others_ = others_ + others_for(left);
}

double Refinement::hope() const {
  return begun() ? best_ - expected_ : start_ - larger * expected_;
}

AmplitudeState Refinement::state() const {
  AmplitudeState state{at(best_factor_, best_others_), best_residual_, from_.changes, errors_, from_.accepted};
  state.accepted.push_back(effect_.candidate);
  state.changes.conservativeResize(per_factor_.size(), state.changes.cols() + 1);
  state.changes.rightCols(1) = per_factor_;
  return state;
}

void take_beside_each_other(std::vector<TestedEffect>& effects, const AmplitudeState& state, const Scores& scores,
                            double dispersion, const EffectProblem& problem) {
  const MatrixXd covariance = scores.information.inverse();
  for (std::size_t k = 0; k < state.accepted.size(); ++k) {
    const auto number = static_cast<Eigen::Index>(k);
    TestedEffect& effect = of_candidate(effects, state.accepted[k]);
    effect.amplitudes = state.amplitudes(problem.candidates[effect.candidate].amplitudes);
    effect.beside = true;
    const VectorXd in_proportion = effect.amplitudes.cwiseAbs() * std::sqrt(covariance(number, number) * dispersion);
    effect.deviations = in_proportion.size() == 1 ? in_proportion : in_proportion.cwiseMax(effect.deviations);
  }
}

double smallest_misfit(const std::vector<const Refinement*>& all) {
  double best = infinite;
  for (const Refinement* one : all) best = std::min(best, one->best());
  return best;
}

void give_up_hopeless(std::vector<Refinement>& all, double best) {
  for (const Refinement& one : all) best = std::min(best, one.best());
  for (Refinement& one : all)
    if (one.hope() > best + hopeless) one.give_up();
}

void put_first_what_runs_ask_for(std::vector<const Refinement*>& all) {
  const double best = smallest_misfit(all);
  std::stable_partition(all.begin(), all.end(), [&](const auto* one) { return one->best() < best + hopeless; });
}

}  // namespace tether
