#include "identification_master/lasting_errors.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace tether {
namespace {

/// R R' = C, symmetric; C may be singular.
MatrixXd root_of(const MatrixXd& C) {
  if (C.size() == 0) return C;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> parts(C);
  return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         parts.eigenvectors().transpose();
}

}  // namespace

void LastingErrors::renew(const std::vector<Eigen::Index>& errors) {
  for (const Eigen::Index k : errors) {
    mean(k) = 0;
    slope.row(k).setZero();
    covariance.row(k).setZero();
    covariance.col(k).setZero();
    covariance(k, k) = 1;
  }
}

void LastingErrors::follow(const MatrixXd& T) {
  if (count() == 0) return;
  const MatrixXd whole = whole_covariance();
  slope = T.partialPivLu().solve(slope.transpose()).transpose();  // L_theta B' stays
  covariance = whole - slope * slope.transpose();
}

LastingInformation::LastingInformation(const LastingErrors& errors, const MatrixXd& columns, const VectorXd& precision,
                                       const VectorXd& D, const MatrixXd& L) {
  const MatrixXd WL = precision.asDiagonal() * L, N = errors.count() > 0 ? columns : MatrixXd(D.size(), 0);
  gamma_ = L.transpose() * WL;
  g_ = WL.transpose() * D;
  squares_ = D.dot(precision.asDiagonal() * D);
  root_ = root_of(errors.covariance);
  slopes_ = N.transpose() * WL;
  means_ = N.transpose() * (precision.asDiagonal() * D);
  const MatrixXd NR = N * root_;
  information_ = NR.transpose() * (precision.asDiagonal() * NR);
}

MatrixXd LastingInformation::conditional(double share) const {
  if (root_.size() == 0) return root_;
  const MatrixXd inner = MatrixXd::Identity(root_.rows(), root_.cols()) + share * information_;
  return root_ * inner.llt().solve(root_.transpose());
}

MatrixXd LastingInformation::gamma(double share) const {
  return share * gamma_ - share * share * (slopes_.transpose() * conditional(share) * slopes_);
}

VectorXd LastingInformation::g(double share) const {
  return share * g_ - share * share * (slopes_.transpose() * (conditional(share) * means_));
}

double LastingInformation::chi_square() const {
  return squares_ - means_.dot(conditional(1) * means_);
}

LastingErrors LastingInformation::learned(const LastingErrors& before, double share, const VectorXd& c,
                                          const MatrixXd& G) const {
  const MatrixXd C = conditional(share), slope = before.slope + share * (C * slopes_);
  return {before.mean + share * (C * means_) + slope * c, slope * G, C};
}

}  // namespace tether
