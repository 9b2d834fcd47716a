#include "diagnosis/search/confirmation.hpp"

namespace tether {

Confirmation::Confirmation(const EffectProblem& problem)
    : problem_(problem), counted_(counted(problem)), trained_(problem), foretold_(counted_) {}

std::vector<int> Confirmation::blocks() const {
  std::vector<int> block;
  for (const Eigen::Index i : counted_.held_out) block.push_back(problem_.block[static_cast<std::size_t>(i)]);
  return block;
}

VectorXd Confirmation::refitted(const VectorXd& residual) const {
  const VectorXd found = trained_.amplitudes(residual);
  VectorXd fitted = residual;
  for (Eigen::Index k = 0; k < found.size(); ++k)
    if (problem_.allowed_deviation(k) == infinite) fitted -= problem_.allowed.col(k) * found(k);
  return fitted;
}

std::optional<Gain> Confirmation::held_out(const VectorXd& before, const VectorXd& after) const {
  const auto& rows = counted_.held_out;
  if (rows.size() < 2) return std::nullopt;
  return gain_of(problem_.precision(rows), blocks(), refitted(before)(rows), refitted(after)(rows), independent());
}

std::optional<Gain> Confirmation::of(const VectorXd& before, const VectorXd& after) const {
  const auto plain = held_out(before, after);
  if (!plain || plain->positive >= sure_gain) return plain;
  return gain_in_misfit(blocks(), foretold_.misfit(before), foretold_.misfit(after), independent());
}

}  // namespace tether
