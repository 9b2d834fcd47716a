#include "identification_master/reduced_order_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

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

/// The correction in deviations that a share of the data makes: -(1 + Gamma)^-1 g.
VectorXd shift_of(const LastingInformation& told, double share) {
  const VectorXd g = told.g(share);
  const MatrixXd U = MatrixXd::Identity(g.size(), g.size()) + told.gamma(share);
  return -U.llt().solve(g);
}

/// The largest share, up to 1, with a shift no longer than `limit`: the length grows with the share.
double tempered_share(const LastingInformation& told, double limit) {
  if (shift_of(told, 1).norm() <= limit) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (shift_of(told, middle).norm() <= limit ? low : high) = middle;
  }
  return low;
}

}  // namespace

ReducedOrderFilter::ReducedOrderFilter(const VectorXd& mean, const MatrixXd& covariance, MatrixXd lasting)
    : columns_(std::move(lasting)), lasting_(LastingErrors::unknown(columns_.cols(), mean.size())) {
  const Eigen::LLT<MatrixXd> L(covariance);
  TETHER_ASSERT(L.info() == Eigen::Success, "the covariance of {} parameters is not positive definite", mean.size());
  particles_ = (L.matrixL() * simplex_points(static_cast<int>(mean.size()))).colwise() + mean;
}

ReducedOrderFilter::ReducedOrderFilter(MatrixXd particles)
    : particles_(std::move(particles)), lasting_(LastingErrors::unknown(0, particles_.rows())) {
  TETHER_ASSERT(particles_.cols() == particles_.rows() + 1, "{} particles for {} parameters", particles_.cols(),
                particles_.rows());
}

void ReducedOrderFilter::restore(MatrixXd particles, LastingErrors lasting) {
  TETHER_ASSERT(particles.cols() == particles.rows() + 1 && lasting.count() == columns_.cols(),
                "{} x {} particles, {} of {} errors that last", particles.rows(), particles.cols(), lasting.count(),
                columns_.cols());
  lasting_ = lasting.count() > 0 ? std::move(lasting) : LastingErrors::unknown(0, particles.rows());
  particles_ = std::move(particles);
}

void ReducedOrderFilter::errors_now(MatrixXd columns, const std::vector<Eigen::Index>& renewed) {
  TETHER_ASSERT(columns.cols() == lasting_.count(), "{} of {} errors that last", columns.cols(), lasting_.count());
  columns_ = std::move(columns);
  lasting_.renew(renewed);
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

MatrixXd ReducedOrderFilter::without_lasting(const MatrixXd& discrepancies) const {
  if (lasting_.count() == 0) return discrepancies;
  const MatrixXd b = (lasting_.slope * simplex_points(static_cast<int>(parameters()))).colwise() + lasting_.mean;
  return discrepancies - columns_ * b;
}

VectorXd ReducedOrderFilter::lasting_variances() const {
  return (columns_ * lasting_.covariance).cwiseProduct(columns_).rowwise().sum();
}

FilterCorrection ReducedOrderFilter::correct(const MatrixXd& discrepancies, const VectorXd& precision,
                                             double largest_shift) {
  const Eigen::Index p = parameters();
  TETHER_ASSERT(discrepancies.cols() == p + 1 && discrepancies.rows() == precision.size(),
                "{} x {} discrepancies for {} particles and {} data", discrepancies.rows(), discrepancies.cols(), p + 1,
                precision.size());
  const MatrixXd D = without_lasting(discrepancies);
  const LastingInformation told(lasting_, columns_, precision, mean_of(D), spread_of(D));
  const MatrixXd one = MatrixXd::Identity(p, p);
  FilterCorrection done;
  done.tempering = tempered_share(told, largest_shift);
  done.shift = shift_of(told, done.tempering);  // (K.3)
  done.chi_square = told.chi_square() - told.g(1).dot((one + told.gamma(1)).llt().solve(told.g(1)));
  const MatrixXd G = symmetric_root((one + told.gamma(done.tempering)).inverse());
  done.mix = mix_of(done.shift, G);  // (K.4)
  lasting_ = told.learned(lasting_, done.tempering, done.shift, G);
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
  const MatrixXd around = triangular.solve(particles_.colwise() - centre), before = spread_of(particles_);
  particles_ = (L * root * around).colwise() + centre;
  lasting_.follow(before.partialPivLu().solve(spread_of(particles_)));
}

MatrixXd ReducedOrderFilter::forget(double share, const MatrixXd& prior) {
  const MatrixXd L = spread_of(particles_);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> over_prior(L.transpose() * prior.llt().solve(L));
  const Eigen::ArrayXd variances = over_prior.eigenvalues().array().min(1);
  const VectorXd growth = ((1 - share) * variances + share).rsqrt();  // (K.6)
  const MatrixXd G = over_prior.eigenvectors() * growth.asDiagonal() * over_prior.eigenvectors().transpose();
  const MatrixXd mix = mix_of(VectorXd::Zero(parameters()), G);
  lasting_.follow(G);
  particles_ = (particles_ * mix.transpose()).eval();
  return mix;
}

}  // namespace tether
