#include "diagnosis/evidence/set_integrand.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/effect.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// exp(-50) is 2e-22: of a sum over less than a million places nothing that a double can hold.
constexpr double beyond_digits = 50;

VectorXd log_of(const VectorXd& sums, double most) {
  return sums.array().log() + most;
}

}  // namespace

MatrixXd PairwiseForm::at(Index first) const {
  const std::size_t n = alone.size();
  MatrixXd all = MatrixXd::Constant(n > 1 ? alone[1].size() : 1, n > 2 ? alone[2].size() : 1, alone[0](first));
  if (n > 1) all.colwise() += alone[1] + pairs[0][1].row(first).transpose();
  if (n > 2) all.rowwise() += (alone[2] + pairs[0][2].row(first).transpose()).transpose();
  if (n > 2) all += pairs[1][2];
  return all;
}

/// Of the normal `b`: exp(b q - b^2 h/2) has the mean exp(q^2/(2 (1 + h)))/(1 + h)^(1/2).
MatrixXd SetIntegrand::at(Index first) const {
  MatrixXd all = density.at(first);
  if (along.alone.empty()) return all;
  const Eigen::ArrayXXd grown = 1 + size.at(first).array();
  all.array() += 0.5 * (along.at(first).array().square() / grown - grown.log());
  return all;
}

Summed summed(const SetIntegrand& integrand) {
  const std::vector<VectorXd>& amplitudes = integrand.density.alone;
  const Index places = amplitudes.front().size();
  std::vector<MatrixXd> slices;
  VectorXd largest(places);
  for (Index i = 0; i < places; ++i) largest(i) = slices.emplace_back(integrand.at(i)).maxCoeff();
  const double most = largest.maxCoeff();
  if (!std::isfinite(most)) return {most, amplitudes};
  std::vector<VectorXd> sums{VectorXd::Zero(places)};
  for (std::size_t k = 1; k < amplitudes.size(); ++k) sums.push_back(VectorXd::Zero(amplitudes[k].size()));
  for (Index i = 0; i < places; ++i) {
    if (largest(i) < most - beyond_digits) continue;
    const MatrixXd weights = (slices[static_cast<std::size_t>(i)].array() - most).exp();
    sums[0](i) = weights.sum();
    if (sums.size() > 1) sums[1] += weights.rowwise().sum();
    if (sums.size() > 2) sums[2] += weights.colwise().sum().transpose();
  }
  Summed found{most + std::log(sums[0].sum()), {}};
  for (const VectorXd& one : sums) found.each.push_back(log_of(one, most));
  return found;
}

double log_sum(const VectorXd& logs) {
  const double most = logs.maxCoeff();
  return std::isfinite(most) ? most + std::log((logs.array() - most).exp().sum()) : most;
}

}  // namespace tether
