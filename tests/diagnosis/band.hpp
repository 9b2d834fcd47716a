#pragma once

/// A linear system to search for effects in: a band of 4 regions times 24 places, 8 training and 4 held-out moments,
/// with noise that is alike over 3 places.
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "diagnosis/search/effect_search.hpp"

namespace tether {
namespace effect_search_test {

using Index = Eigen::Index;

constexpr int regions = 4, in_region = 24, places = regions * in_region, moments = 12;
constexpr double correlation = 3;  // of places

inline double beat(int moment) {
  return 0.5 * (1 - std::cos(2 * std::numbers::pi * moment / moments));
}

/// What a unit of an effect in `region` does: it grows with the beat; `width` in places, smooth.
inline VectorXd response(int region, double width, const std::function<double(int)>& in_time) {
  VectorXd all(places * moments);
  for (int m = 0; m < moments; ++m)
    for (int i = 0; i < places; ++i) {
      double away = std::abs(i - (region + 0.5) * in_region);
      away = std::min(away, places - away);
      all(m * places + i) = in_time(m) * std::exp(-0.5 * away * away / (width * width));
    }
  return all;
}

/// Noise of deviation 1 with the correlation exp(-r/l) along the band, new in each moment.
inline VectorXd noise(std::mt19937_64& generator) {
  std::normal_distribution<double> normal;
  const double a = std::exp(-1 / correlation), b = std::sqrt(1 - a * a);
  VectorXd all(places * moments);
  for (int m = 0; m < moments; ++m) {
    double now = normal(generator);
    for (int i = 0; i < places; ++i) all(m * places + i) = now = i == 0 ? now : a * now + b * normal(generator);
  }
  return all;
}

inline void add_candidate(EffectProblem& problem, const std::string& name, const VectorXd& change,
                          bool one_sided = true) {
  problem.candidates.push_back({name, "band", name, Candidate::Kind::effect, {problem.changes.cols()}});
  problem.amplitudes.push_back({name, name, "1", one_sided, 5.0, 0, false});
  problem.changes.conservativeResize(change.size(), problem.changes.cols() + 1);
  problem.changes.rightCols(1) = change;
}

/// Four springs and four masses; patterns of all regions and moments. naive: as if all errors were independent.
inline EffectProblem band(bool naive = false) {
  EffectProblem problem;
  const Index n = places * moments;
  problem.independent = VectorXd::Constant(n, naive ? 1.0 : 1 / (2 * correlation));
  problem.precision = problem.independent;
  problem.changes.resize(n, 0);
  problem.allowed.resize(n, 0);
  problem.patterns = MatrixXd::Zero(n, regions * moments);
  for (int m = 0; m < moments; ++m)
    for (int i = 0; i < places; ++i) {
      const int block = m * regions + i / in_region;
      problem.block.push_back(m * 8 + i / 12);
      problem.moment.push_back(m);
      problem.patterns(m * places + i, block) = 1;
      (m % 3 == 2 ? problem.held_out : problem.training).push_back(m * places + i);
    }
  problem.pattern_deviation = VectorXd::Constant(regions * moments, 0.25);
  for (int m = 0; m < moments; ++m)
    for (int r = 0; r < regions; ++r) problem.pattern_names.push_back({std::to_string(r), static_cast<double>(m)});
  for (int r = 0; r < regions; ++r) {
    add_candidate(problem, "spring_" + std::to_string(r), response(r, 8, beat));
    add_candidate(problem, "mass_" + std::to_string(r),
                  response(r, 8, [](int m) { return std::sin(4 * std::numbers::pi * m / moments); }));
  }
  return problem;
}

inline SearchResult found(const EffectProblem& problem, const SearchSettings& settings = {}) {
  return search_effects(problem, settings, linear_residual(problem));
}

/// The effect of a candidate, which must have been tested.
inline TestedEffect effect_of(const SearchResult& result, std::size_t candidate) {
  for (const TestedEffect& effect : result.effects)
    if (effect.candidate == candidate) return effect;
  throw std::logic_error("the candidate was not tested");
}

inline double share(const std::function<bool(std::mt19937_64&)>& happens, int trials = 200) {
  int count = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(1000 + trial));
    count += happens(generator) ? 1 : 0;
  }
  return static_cast<double>(count) / trials;
}

}  // namespace effect_search_test
}  // namespace tether
