#include "diagnosis/search/effect_tests.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/results/further_data.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

std::vector<bool> sides(const EffectProblem& problem, const std::vector<Index>& of) {
  std::vector<bool> one_sided;
  for (const Index i : of) one_sided.push_back(problem.amplitudes[static_cast<std::size_t>(i)].one_sided);
  return one_sided;
}

/// z of the same probability, for people.
double as_z(double p) {
  return p > 1e-300 ? -normal_quantile(std::min(p, 1 - 1e-12)) : 37;
}

double probability(double gain, const std::vector<bool>& one_sided) {
  const int n = static_cast<int>(one_sided.size());
  const bool any = std::any_of(one_sided.begin(), one_sided.end(), [](bool one) { return one; });
  return any ? one_sided_tail(gain, n) : chi_square_tail(gain, n);  // (D.10)
}

/// Of each amplitude while the others of the effect are free; infinite where the data say nothing of it.
VectorXd deviations_of(const MatrixXd& information) {
  const VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd one = MatrixXd::Identity(scale.size(), scale.size());
  constexpr double unseen = 1e-10;  // of the information: amplitudes that do the same are known together only
  const MatrixXd covariance = (scale.asDiagonal() * information * scale.asDiagonal() + unseen * one).ldlt().solve(one);
  return scale.cwiseProduct(covariance.diagonal().cwiseSqrt());
}

TestedEffect test(const EffectProblem& problem, std::size_t number, const Scores& scores, double count) {
  const std::vector<Index>& own = problem.candidates[number].amplitudes;
  const MatrixXd information = scores.information(own, own);
  const std::vector<bool> one_sided = sides(problem, own);
  const Fit fit = best_fit(information, scores.response(own), one_sided);
  TestedEffect effect;
  effect.candidate = number;
  effect.gain = fit.gain;
  const double spread = std::max(1.0, (scores.misfit - fit.gain) / count);  // noise that is larger than stated
  effect.p = probability(fit.gain / spread, one_sided);
  effect.z = fit.gain > 0 ? (own.size() == 1 ? std::sqrt(fit.gain / spread) : as_z(effect.p)) : 0;
  if (own.size() == 1 && scores.response(own[0]) < 0)
    effect.z = scores.response(own[0]) / std::sqrt(spread * information(0, 0));
  effect.amplitudes = fit.amplitudes;
  effect.deviations = deviations_of(information);
  for (std::size_t k = 0; k < own.size(); ++k) {
    const double size = effect.amplitudes(static_cast<Index>(k));
    if (problem.amplitudes[static_cast<std::size_t>(own[k])].limited(size) != size) effect.at_limit = true;
  }
  const double alone = scores.alone(own).sum();
  effect.retained = alone > 0 ? information.trace() / alone : 0;
  return effect;
}

}  // namespace

double chance_of(const EffectProblem& problem, std::size_t candidate, double gain) {
  return probability(gain, sides(problem, problem.candidates[candidate].amplitudes));
}

VectorXd as_in_patients(const EffectProblem& problem, const TestedEffect& effect) {
  const auto& own = problem.candidates[effect.candidate].amplitudes;
  const auto scale = [&](Index k) {
    return problem.amplitudes[static_cast<std::size_t>(own[static_cast<std::size_t>(k)])].scale;
  };
  VectorXd amplitudes = effect.amplitudes;
  double largest = 0;
  for (Index k = 0; k < amplitudes.size(); ++k) largest = std::max(largest, std::abs(amplitudes(k)) / scale(k));
  if (largest > 0) return amplitudes / largest;
  amplitudes(0) = scale(0);
  return amplitudes;
}

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

namespace {

constexpr double at_most = 100;  ///< times what was found

/// What the effect does at a factor of its amplitude, over what it does as found; c: `TestedEffect::saturation`.
double does_at(double factor, double c) {
  return factor > 0 ? factor * (1 + c) / (1 + c * factor) : factor;
}

/// The factor of its amplitude at which the effect does so much of what it does as found.
double factor_for(double does, double c) {
  return does > 0 ? does / std::max(1 + c - c * does, does / at_most) : does;
}

AmplitudeRange range_of(const AmplitudeInterval& interval, double size, double saturation) {
  const auto [least, most] = std::minmax({interval.least / size, interval.most / size});
  const double lower = std::min(least, 1.0), upper = std::clamp(most, 1.0, at_most);
  return {lower, upper, does_at(lower, saturation), does_at(upper, saturation)};
}

/// Whether runs found the amplitude where the table has it.
bool holds(const AmplitudeInterval& interval, double size) {
  return interval.least < size && size < interval.most;
}

/// Of one of several, known to first order.
AmplitudeRange range_about(const AmplitudeInterval& interval, double saturation) {
  const auto [least, most] = std::minmax({interval.least / interval.middle, interval.most / interval.middle});
  return {factor_for(least, saturation), factor_for(most, saturation), least, most};
}

/// By the deviation along runs, known in the logarithm of what the amplitude does.
AmplitudeRange range_along_runs(const TestedEffect& effect, double half, bool one_sided, double c) {
  if (!one_sided) return {1 - half, 1 + half, 1 - half, 1 + half};
  const double least = std::max(0.0, 1 - half);
  if (!effect.confirmed) return {least, 1 + half, least, 1 + half};
  const double does = std::exp(half / (1 + c));
  const double most = std::min(does, factor_for(does, c) < at_most ? does : (1 + c) / (c + 1 / at_most));
  return {factor_for(1 / does, c), factor_for(does, c), 1 / does, most};
}

AmplitudeRange both(const AmplitudeRange& a, const AmplitudeRange& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper), std::min(a.does_least, b.does_least),
          std::max(a.does_most, b.does_most)};
}

}  // namespace

AmplitudeRange range_of(const EffectProblem& problem, const TestedEffect& effect, Eigen::Index own) {
  const Candidate& candidate = problem.candidates[effect.candidate];
  const Amplitude& amplitude =
      problem.amplitudes[static_cast<std::size_t>(candidate.amplitudes[static_cast<std::size_t>(own)])];
  const double size = effect.amplitudes(own), half = two_sided_95 * effect.deviations(own) / std::abs(size);
  if (size == 0) return {};
  const double c = std::max(0.0, effect.saturation);
  const auto& interval = effect.intervals.empty() ? std::nullopt : effect.intervals[static_cast<std::size_t>(own)];
  const AmplitudeRange along = range_along_runs(effect, half, amplitude.one_sided, c);
  if (interval && effect.intervals.size() == 1) {
    const AmplitudeRange weighed = range_of(*interval, size, c);
    return effect.beside || !holds(*interval, size) ? both(weighed, along) : weighed;
  }
  return interval && interval->middle * size > 0 ? range_about(*interval, c) : along;
}

std::vector<TestedEffect> test_all(const EffectProblem& problem, const Scores& scores, double count) {
  std::vector<TestedEffect> all;
  std::vector<double> p;
  for (std::size_t i = 0; i < problem.candidates.size(); ++i) {
    TestedEffect& effect = all.emplace_back(test(problem, i, scores, count));
    p.push_back(effect.p);
  }
  const std::vector<double> q = holm(p);
  for (std::size_t i = 0; i < all.size(); ++i) all[i].q = q[i];
  return all;
}

MatrixXd cosines_of_first(const std::vector<TestedEffect>& effects, int count, const EffectProblem& problem,
                          const Scores& scores) {
  const auto all = std::min<Index>(count, static_cast<Index>(effects.size()));
  MatrixXd cosines(all, all);
  for (Index i = 0; i < all; ++i)
    for (Index j = 0; j < all; ++j)
      cosines(i, j) =
          cosine(problem, scores, effects[static_cast<std::size_t>(i)], effects[static_cast<std::size_t>(j)]);
  return cosines;
}

double worth(const EffectProblem& problem, const TestedEffect& effect, double count) {
  const double gain = effect.confirmed ? effect.confirmed_gain : effect.gain;
  const auto& own = problem.candidates[effect.candidate].amplitudes;
  double price = static_cast<double>(own.size()) * std::log(count);
  for (std::size_t k = 0; k < own.size(); ++k)
    if (const double scale = problem.amplitudes[static_cast<std::size_t>(own[k])].scale; scale > 0)
      price += 2 * std::log1p(std::abs(effect.amplitudes(static_cast<Index>(k))) / scale);  // log-uniform
  return gain - price;
}

namespace {

/// That noise makes what all directions together are off by.
double pooled_chance(const Scores& scores) {
  const VectorXd size = scores.information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factor;
  factor.setThreshold(1e-6);
  factor.compute(size.asDiagonal() * scores.information * size.asDiagonal());
  const VectorXd response = size.cwiseProduct(scores.response);
  return chi_square_tail(response.dot(factor.solve(response)), static_cast<int>(factor.rank()));
}

}  // namespace

LackOfFit lack_of_fit(const EffectProblem& problem, const Trained& trained, const VectorXd& residual) {
  LackOfFit lack;
  if (problem.patterns.cols() == 0) return lack;
  const Scores scores = trained.scores(problem.patterns, residual);
  double smallest = 1;
  int seen = 0, moments = 0;
  for (Index k = 0; k < scores.response.size(); ++k) {
    if (!(scores.information(k, k) > 1e-9 * scores.alone(k)) || scores.alone(k) == 0) continue;
    ++seen;
    const double z = scores.response(k) / std::sqrt(scores.information(k, k));
    const bool is_moment = !std::isnan(problem.pattern_names[static_cast<std::size_t>(k)].time);
    if (is_moment) lack.excess += z * z - 1, ++moments;
    if (const double p = 2 * normal_tail(std::abs(z)); p < smallest) {
      smallest = p;
      lack.worst = static_cast<std::size_t>(k);
      lack.z = z;
    }
  }
  lack.p = std::min(1.0, seen * smallest);
  lack.pooled = pooled_chance(scores);
  lack.excess = std::max(0.0, lack.excess);
  const double limit = seen > 0 ? -normal_quantile(0.025 / seen) : 0;
  lack.beyond_noise = std::max({0.0, lack.excess - 1.645 * std::sqrt(2.0 * moments), lack.z * lack.z - limit * limit});
  return lack;
}

void set_groups(std::vector<TestedEffect>& effects, const EffectProblem& problem, const Scores& scores, double count,
                const std::vector<std::size_t>& rival_of) {
  std::vector<TestedEffect*> order;
  for (TestedEffect& effect : effects) order.push_back(&effect);
  std::stable_sort(order.begin(), order.end(), [&](const auto* a, const auto* b) {
    if (a->accepted != b->accepted) return a->accepted;
    return worth(problem, *a, count) > worth(problem, *b, count);
  });
  int groups = 0;
  for (TestedEffect* first : order) {
    if (first->group >= 0) continue;
    bool any = false;
    for (TestedEffect* other : order) {
      if (other == first || other->group >= 0 || other->accepted) continue;
      const double c = cosine(problem, scores, *first, *other);
      if (rival_of[other->candidate] != first->candidate &&
          (c * c <= look_alike || first->gain * (1 - c * c) >= telling))
        continue;
      other->group = groups;
      other->cosine = c;
      any = true;
    }
    if (!any) continue;
    first->group = groups++;
    first->cosine = 1;
  }
}

}  // namespace tether
