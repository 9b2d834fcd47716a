#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// What is known of errors of data that last, N b: at the place xi among the particles (in their
/// deviations) b is normal with the mean m + B xi and the covariance C. (K.8)
struct LastingErrors {
  VectorXd mean;        ///< m [q]
  MatrixXd slope;       ///< B [q x p]
  MatrixXd covariance;  ///< C [q x q]

  /// Before the data: b ~ N(0, 1), whatever the parameters are.
  static LastingErrors unknown(Eigen::Index q, Eigen::Index p) {
    return {VectorXd::Zero(q), MatrixXd::Zero(q, p), MatrixXd::Identity(q, q)};
  }
  Eigen::Index count() const { return mean.size(); }
  /// Of b, whatever xi is.
  MatrixXd whole_covariance() const { return covariance + slope * slope.transpose(); }
  /// Some begin anew, as before any data, whatever the parameters are: what was found of them is over.
  void renew(const std::vector<Eigen::Index>& errors);
  /// The particles spread, or draw together, by T [p x p] and nothing else is learned: L_theta <- L_theta T.
  void follow(const MatrixXd& T);
};

/// What data say of xi and b together, in sums over the data: all that a correction needs. (K.8)
class LastingInformation {
 public:
  /// columns: N [m x q]; D: discrepancies of the mean, with m + B xi taken off, L: their spread [m x p].
  LastingInformation(const LastingErrors& errors, const MatrixXd& columns, const VectorXd& precision, const VectorXd& D,
                     const MatrixXd& L);

  /// What a share of the data says of xi: Gamma and g, b being free within what is known of it.
  MatrixXd gamma(double share) const;
  VectorXd g(double share) const;
  /// D' (W^-1 + N C N')^-1 D.
  double chi_square() const;
  /// The errors after the data, where the particles move by c and spread by G. (K.4)
  LastingErrors learned(const LastingErrors& before, double share, const VectorXd& c, const MatrixXd& G) const;

 private:
  MatrixXd conditional(double share) const;  ///< (C^-1 + share N'W N)^-1

  MatrixXd gamma_, slopes_, root_, information_;  ///< L'W L, N'W L, R, R'N'W N R with R R' = C
  VectorXd g_, means_;                            ///< L'W D, N'W D
  double squares_;                                ///< D'W D
};

}  // namespace tether
