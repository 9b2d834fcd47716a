#pragma once

#include "common/base/types.hpp"

namespace tether {

/// M = W - W N (P^-1 + N'W N)^-1 N'W, the precision of data whose errors are those of W and, beside them, combinations
/// of the columns N with amplitudes of known deviations: M is the inverse of W^-1 + N P N'. (D.8)
class AllowedErrors {
 public:
  /// precision: W, of each datum [n]. columns: N [n x k]. deviations: of their amplitudes [k]; infinite: anything is
  /// allowed, and what is left of the data is orthogonal to the column.
  AllowedErrors(VectorXd precision, const MatrixXd& columns, const VectorXd& deviations);

  /// M x, for each column of x [n x m].
  MatrixXd operator()(const MatrixXd& x) const;
  const VectorXd& precision() const { return precision_; }
  /// The amplitudes of the columns that are most probable if the data are off by x [k].
  VectorXd amplitudes(const VectorXd& x) const;

 private:
  VectorXd precision_, deviation_;
  MatrixXd scaled_, inverse_;  ///< W N P^(1/2); (1 + P^(1/2) N'W N P^(1/2))^-1
};

/// All that the data say about amplitudes to first order. (D.9)
struct Scores {
  MatrixXd information;  ///< S'M S
  VectorXd response;     ///< S'M r
  VectorXd alone;        ///< diagonal of S'W S: the information if nothing else were allowed
  double misfit = 0;     ///< r'M r
};
/// changes: S, by how much the model moves toward larger data, per amplitude [n x q]; residual: r, data minus model
/// [n].
Scores scores_of(const AllowedErrors& allowed, const MatrixXd& changes, const VectorXd& residual);

/// The amplitudes that reduce the misfit most, those of `one_sided` not negative, and by how much.
struct Fit {
  VectorXd amplitudes;
  double gain = 0;  ///< of r'M r
};
/// information, response: of these amplitudes only. At most a dozen one-sided ones: all sides are tried.
Fit best_fit(const MatrixXd& information, const VectorXd& response, const std::vector<bool>& one_sided);

}  // namespace tether
