#include "diagnosis/effect_problem.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double farthest = 4;  ///< in scales: beyond, a number is that of no patient, and the model breaks

}  // namespace

double Amplitude::value(double amplitude) const {
  const double far = scale > 0 ? farthest * scale : infinite;
  const double value = doubles ? base * std::exp2(std::clamp(amplitude, -far, far)) : base + amplitude;
  const double least = std::isfinite(lower) ? lower + 0.01 * (base - lower) : lower;
  const double most = std::isfinite(upper) ? upper - 0.01 * (upper - base) : upper;
  return std::clamp(value, std::min(least, base), std::max(most, base));
}

bool is_variant(const Candidate& one, const Candidate& other) {
  const bool named = one.name.ends_with("_" + other.name) || other.name.ends_with("_" + one.name);
  return named && one.where == other.where && one.parameter == other.parameter;
}

ResidualAt linear_residual(const EffectProblem& problem) {
  return [&problem](const MatrixXd& amplitudes) -> MatrixXd {
    return (-problem.changes * amplitudes).colwise() + problem.residual;
  };
}

}  // namespace tether
