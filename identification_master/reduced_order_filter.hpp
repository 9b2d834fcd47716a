#pragma once

#include <limits>

#include "identification_master/lasting_errors.hpp"

namespace tether {

/// What a step of data did to the particles.
struct FilterCorrection {
  MatrixXd mix;  ///< [(p+1) x (p+1)] new particle i = sum_j mix(i, j) particle j, of parameters and states alike; rows
                 ///< sum to 1
  VectorXd shift;  ///< [p] of the mean, in deviations before the data
  double chi_square =
      0;  ///< of the mean discrepancy under its predicted covariance: about `observations` if model and noise are right
  double tempering = 1;  ///< share of the data's weight that was used
};

/// The reduced-order unscented Kalman filter (Moireau and Chapelle 2011; Moireau et al. 2012): p parameters carried by
/// p + 1 particles. Between two corrections the particles ARE the distribution (U = 1): nothing else is kept, and a
/// step without data changes nothing. States are the caller's; they follow by `mix`. Discrepancies are data minus
/// model. Errors of the data that last are found beside the parameters, without particles of their own (K.8).
class ReducedOrderFilter {
 public:
  /// A normal distribution of theta: mean [p], covariance [p x p], positive definite. lasting: what errors of deviation
  /// 1 that last do to the first data [m x q]; none: no columns.
  ReducedOrderFilter(const VectorXd& mean, const MatrixXd& covariance, MatrixXd lasting = {});
  /// From particles, one a column [p x (p+1)].
  explicit ReducedOrderFilter(MatrixXd particles);
  /// Goes on from particles and what is known of the errors that last.
  void restore(MatrixXd particles, LastingErrors lasting);

  Eigen::Index parameters() const { return particles_.rows(); }
  const MatrixXd& particles() const { return particles_; }
  VectorXd mean() const;
  MatrixXd covariance() const;
  const LastingErrors& lasting() const { return lasting_; }
  const MatrixXd& lasting_columns() const { return columns_; }
  /// What they do to the data that come now [m x q]; renewed: those that are other errors than before.
  void errors_now(MatrixXd columns, const std::vector<Eigen::Index>& renewed);
  /// Without the errors that last, as each particle has them [m x (p+1)].
  MatrixXd without_lasting(const MatrixXd& discrepancies) const;
  /// Variances of what the data may be off by the errors that last, the parameters given [m].
  VectorXd lasting_variances() const;

  /// discrepancies: one particle a column [m x (p+1)]; precision: inverse variances [m], zero for no observation.
  /// If the mean would move by more than `largest_shift` deviations the data get less weight. (K.3)
  FilterCorrection correct(const MatrixXd& discrepancies, const VectorXd& precision,
                           double largest_shift = std::numeric_limits<double>::infinity());

  /// The parameters have walked at random: adds variances [p] to their covariance; states do not follow. (K.6)
  void diffuse(const VectorXd& variances);
  /// Of what is known beyond the prior only this share is kept: parameters and states spread, never beyond the prior's
  /// covariance [p x p] by this; the mean stays. Returns the mix. (K.6)
  MatrixXd forget(double share, const MatrixXd& prior);

  /// The columns' mean [m], and their derivative by the unit points, L of (K.3) [m x p].
  static VectorXd mean_of(const MatrixXd& columns);
  static MatrixXd spread_of(const MatrixXd& columns);

 private:
  MatrixXd particles_;
  MatrixXd columns_;  ///< N of (K.8)
  LastingErrors lasting_;
};

}  // namespace tether
