#include "diagnosis/evidence/scores.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// Of what may be anything, as much as leaves a hundred-millionth of its information.
constexpr double as_good_as_infinite = 1e4;

/// The minimiser over some amplitudes, the others zero. Directions that the data do not see stay zero.
VectorXd solve(const MatrixXd& information, const VectorXd& response, const std::vector<Eigen::Index>& kept) {
  VectorXd all = VectorXd::Zero(response.size());
  if (kept.empty()) return all;
  const MatrixXd some = information(kept, kept);
  const VectorXd scale = some.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * some * scale.asDiagonal());
  const VectorXd& values = eigen.eigenvalues();
  const VectorXd inverse = (values.array() > 1e-10 * values.maxCoeff()).select(values.cwiseInverse(), 0);
  const VectorXd right = eigen.eigenvectors().transpose() * (scale.asDiagonal() * VectorXd(response(kept)));
  all(kept) = scale.asDiagonal() * (eigen.eigenvectors() * (inverse.asDiagonal() * right));
  return all;
}

}  // namespace

AllowedErrors::AllowedErrors(VectorXd precision, const MatrixXd& columns, const VectorXd& deviations)
    : precision_(std::move(precision)) {
  TETHER_ASSERT(columns.rows() == precision_.size() && columns.cols() == deviations.size(), "{} x {} columns",
                columns.rows(), columns.cols());
  scaled_ = columns;
  deviation_.resize(columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double information = columns.col(k).dot(precision_.cwiseProduct(columns.col(k)));
    const double deviation = std::isfinite(deviations(k)) ? deviations(k)
                             : information > 0            ? as_good_as_infinite / std::sqrt(information)
                                                          : 0;
    scaled_.col(k) *= deviation;
    deviation_(k) = deviation;
  }
  const MatrixXd weighted = precision_.asDiagonal() * scaled_;
  const MatrixXd one = MatrixXd::Identity(columns.cols(), columns.cols());
  inverse_ = (one + scaled_.transpose() * weighted).ldlt().solve(one);
  scaled_ = weighted;
}

MatrixXd AllowedErrors::operator()(const MatrixXd& x) const {
  return precision_.asDiagonal() * x - scaled_ * (inverse_ * (scaled_.transpose() * x));  // (D.8)
}

VectorXd AllowedErrors::amplitudes(const VectorXd& x) const {
  return deviation_.cwiseProduct(inverse_ * (scaled_.transpose() * x));
}

Scores scores_of(const AllowedErrors& allowed, const MatrixXd& changes, const VectorXd& residual) {
  const MatrixXd weighted = allowed(changes);
  Scores scores;
  scores.information = changes.transpose() * weighted;
  scores.response = weighted.transpose() * residual;
  scores.alone = (changes.array().square().colwise() * allowed.precision().array()).colwise().sum();
  scores.misfit = residual.dot(allowed(residual).col(0));
  return scores;
}

Fit best_fit(const MatrixXd& information, const VectorXd& response, const std::vector<bool>& one_sided) {
  std::vector<Eigen::Index> free, sided;
  for (Eigen::Index i = 0; i < response.size(); ++i)
    (one_sided[static_cast<std::size_t>(i)] ? sided : free).push_back(i);
  TETHER_ASSERT(sided.size() <= 12, "{} one-sided amplitudes", sided.size());
  Fit best{VectorXd::Zero(response.size()), 0};
  for (unsigned chosen = 0; chosen < 1U << sided.size(); ++chosen) {
    std::vector<Eigen::Index> kept = free;
    for (std::size_t i = 0; i < sided.size(); ++i)
      if ((chosen >> i & 1U) != 0) kept.push_back(sided[i]);
    const VectorXd amplitudes = solve(information, response, kept);
    bool admissible = true;
    for (const Eigen::Index i : sided) admissible = admissible && amplitudes(i) >= 0;
    const double gain = response.dot(amplitudes);
    if (admissible && gain > best.gain) best = {amplitudes, gain};
  }
  return best;
}

}  // namespace tether
