#include "identification_master/identifiability.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace tether {
namespace {

/// Information, in that of the prior, below which data told nothing: what curvature of the model alone can pretend.
constexpr double told = 0.1;

}  // namespace

Identifiability identifiability(const MatrixXd& prior, const MatrixXd& posterior) {
  const auto p = prior.rows();
  const MatrixXd root = Eigen::SelfAdjointEigenSolver<MatrixXd>(prior).operatorSqrt();
  const MatrixXd gramian = root * posterior.llt().solve(root) - MatrixXd::Identity(p, p);  // (K.7)
  const Eigen::SelfAdjointEigenSolver<MatrixXd> spectrum((gramian + gramian.transpose()) / 2);
  Identifiability result{(gramian + gramian.transpose()) / 2, spectrum.eigenvalues().reverse(),
                         spectrum.eigenvectors().rowwise().reverse(), VectorXd(p)};
  const MatrixXd inverse = (gramian + MatrixXd::Identity(p, p)).inverse();
  for (Eigen::Index i = 0; i < p; ++i) {
    const double alone = gramian(i, i), with_others = 1 / inverse(i, i) - 1;
    result.retained(i) = alone > told ? std::max(0.0, with_others) / alone : 0;
  }
  return result;
}

MatrixXd correlations(const MatrixXd& covariance) {
  const VectorXd scale = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

}  // namespace tether
