#include "diagnosis/evidence/effect_problem.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double farthest = 10;  ///< doublings: a thousandfold is no longer the same model

/// Two patches of the wall, or one that a region has most of and the region: how exactly the place is known.
bool is_within(const Candidate& one, const Candidate& other) {
  if (one.extent.about && other.extent.about) return true;
  if (one.extent.about) return !one.mostly_in.empty() && one.mostly_in == other.part;
  return other.extent.about && !other.mostly_in.empty() && other.mostly_in == one.part;
}

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
  const auto is_of = [](const Candidate& shape, const std::string& effect) {
    return !effect.empty() && shape.variant_of == effect;
  };
  const bool same_law = !one.type.empty() && one.type == other.type && one.number == other.number;
  if (same_law && is_within(one, other)) return true;
  const bool same_number = !one.type.empty() && one.part == other.part && one.number == other.number;
  if (same_number && one.type == other.type && one.extent.is_all() != other.extent.is_all()) return true;
  if (same_number && one.extent == other.extent && (is_of(one, other.type) || is_of(other, one.type))) return true;
  return (is_of(one, other.name) || is_of(other, one.name)) && one.where == other.where &&
         one.parameter == other.parameter;
}

std::vector<Eigen::Index> naming_rows(const EffectProblem& problem) {
  std::vector<Eigen::Index> rows = problem.training;
  rows.insert(rows.end(), problem.held_out.begin(), problem.held_out.end());
  std::erase_if(rows, [&](Eigen::Index i) {
    return std::find(problem.sealed.begin(), problem.sealed.end(), i) != problem.sealed.end();
  });
  return rows;
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
