#include "diagnosis/evidence/effect_problem.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double farthest = 10;  ///< doublings: a thousandfold is no longer the same model

}  // namespace

double Amplitude::limited(double amplitude) const {
  const double least = std::isfinite(lower) ? lower + 0.01 * (base - lower) : lower;
  const double most = std::isfinite(upper) ? upper - 0.01 * (upper - base) : upper;
  double low = least - base, high = most - base;
  if (doubles) {
    low = least > 0 ? std::max(-farthest, std::log2(least / base)) : -farthest;
    high = std::min(farthest, std::log2(most / base));
  }
  return std::clamp(amplitude, std::min(low, 0.0), std::max(high, 0.0));
}

double Amplitude::value(double amplitude) const {
  return doubles ? base * std::exp2(limited(amplitude)) : base + limited(amplitude);
}

bool is_variant(const Candidate& one, const Candidate& other) {
  const bool is_part = one.band.is_all() != other.band.is_all();
  if (is_part && !one.type.empty() && one.type == other.type && one.part == other.part && one.number == other.number)
    return true;
  const bool variant = one.variant_of == other.name || other.variant_of == one.name;
  return variant && one.where == other.where && one.parameter == other.parameter;
}

EffectProblem with_discrepancy(EffectProblem problem, double size) {
  problem.allowed_deviation(problem.allowed_patterns) *= size;
  return problem;
}

ResidualAt linear_residual(const EffectProblem& problem) {
  return [&problem](const MatrixXd& amplitudes) -> MatrixXd {
    return (-problem.changes * amplitudes).colwise() + problem.residual;
  };
}

}  // namespace tether
