#include "identification_master/reduced_order_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/base/error.hpp"
#include "identification_master/sigma_points.hpp"

namespace tether {
namespace {

/// S with S S = A, A symmetric positive definite.
MatrixXd symmetric_root(const MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A).operatorSqrt();
}

/// Particles around their mean, moved by c and with the spread G: sum_j a_j [1 + I_j'(c + G I_i)] X_j for X_i.
MatrixXd mix_of(const VectorXd& c, const MatrixXd& G) {
  const Eigen::Index p = c.size();
  const MatrixXd I = simplex_points(static_cast<int>(p));
  const MatrixXd places = (G * I).colwise() + c;  // in deviations
  return (MatrixXd::Ones(p + 1, p + 1) + places.transpose() * I) / static_cast<double>(p + 1);
}

/// The correction in deviations that a share of the data makes: -(1 + s Gamma)^-1 s g.
VectorXd shift_of(const MatrixXd& gamma, const VectorXd& g, double share) {
  const MatrixXd U = MatrixXd::Identity(g.size(), g.size()) + share * gamma;
  return -U.llt().solve(share * g);
}

/// The largest share, up to 1, with a shift no longer than `limit`: the length grows with the share.
double tempered_share(const MatrixXd& gamma, const VectorXd& g, double limit) {
  if (shift_of(gamma, g, 1).norm() <= limit) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (shift_of(gamma, g, middle).norm() <= limit ? low : high) = middle;
  }
  return low;
}

}  // namespace

ReducedOrderFilter::ReducedOrderFilter(const VectorXd& mean, const MatrixXd& covariance) {
  const Eigen::LLT<MatrixXd> L(covariance);
  TETHER_ASSERT(L.info() == Eigen::Success, "the covariance of {} parameters is not positive definite", mean.size());
  particles_ = (L.matrixL() * simplex_points(static_cast<int>(mean.size()))).colwise() + mean;
}

ReducedOrderFilter::ReducedOrderFilter(MatrixXd particles) : particles_(std::move(particles)) {
  TETHER_ASSERT(particles_.cols() == particles_.rows() + 1, "{} particles for {} parameters", particles_.cols(),
                particles_.rows());
}

VectorXd ReducedOrderFilter::mean_of(const MatrixXd& columns) {
  return columns.rowwise().mean();
}

MatrixXd ReducedOrderFilter::spread_of(const MatrixXd& columns) {
  const auto points = columns.cols();
  const MatrixXd around =
      columns.colwise() - mean_of(columns);  // first the difference: what all have in common may be large
  return around * simplex_points(static_cast<int>(points - 1)).transpose() / static_cast<double>(points);
}

VectorXd ReducedOrderFilter::mean() const {
  return mean_of(particles_);
}

MatrixXd ReducedOrderFilter::covariance() const {
  const MatrixXd L = spread_of(particles_);
  return L * L.transpose();
}

FilterCorrection ReducedOrderFilter::correct(const MatrixXd& discrepancies, const VectorXd& precision,
                                             double largest_shift) {
  const Eigen::Index p = parameters();
  TETHER_ASSERT(discrepancies.cols() == p + 1 && discrepancies.rows() == precision.size(),
                "{} x {} discrepancies for {} particles and {} data", discrepancies.rows(), discrepancies.cols(), p + 1,
                precision.size());
  const VectorXd mean = mean_of(discrepancies);
  const MatrixXd L = spread_of(discrepancies), WL = precision.asDiagonal() * L;
  const MatrixXd gamma = L.transpose() * WL;  // L_d' W L_d
  const VectorXd g = WL.transpose() * mean;   // L_d' W D
  FilterCorrection done;
  done.tempering = tempered_share(gamma, g, largest_shift);
  const MatrixXd U = MatrixXd::Identity(p, p) + done.tempering * gamma;  // (K.3)
  done.shift = shift_of(gamma, g, done.tempering);
  done.chi_square = mean.dot(precision.asDiagonal() * mean) - g.dot((MatrixXd::Identity(p, p) + gamma).llt().solve(g));
  const MatrixXd G = symmetric_root(U.inverse());
  done.mix = mix_of(done.shift, G);  // (K.4)
  particles_ = (particles_ * done.mix.transpose()).eval();
  return done;
}

void ReducedOrderFilter::diffuse(const VectorXd& variances) {
  if (variances.isZero(0)) return;
  const MatrixXd L = covariance().llt().matrixL();
  const auto triangular = L.triangularView<Eigen::Lower>();
  const MatrixXd half = triangular.solve(MatrixXd(variances.asDiagonal())),
                 added = triangular.solve(half.transpose());  // L^-1 Q L^-T
  const MatrixXd root = symmetric_root(MatrixXd::Identity(L.rows(), L.cols()) + added);
  const VectorXd centre = mean();
  const MatrixXd around = triangular.solve(particles_.colwise() - centre);
  particles_ = (L * root * around).colwise() + centre;
}

MatrixXd ReducedOrderFilter::forget(double share, const MatrixXd& prior) {
  const MatrixXd L = spread_of(particles_);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> over_prior(L.transpose() * prior.llt().solve(L));
  const Eigen::ArrayXd variances = over_prior.eigenvalues().array().min(1);
  const VectorXd growth = ((1 - share) * variances + share).rsqrt();  // (K.6)
  const MatrixXd mix = mix_of(VectorXd::Zero(parameters()),
                              over_prior.eigenvectors() * growth.asDiagonal() * over_prior.eigenvectors().transpose());
  particles_ = (particles_ * mix.transpose()).eval();
  return mix;
}

}  // namespace tether
