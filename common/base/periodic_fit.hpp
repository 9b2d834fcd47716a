#pragma once

#include <span>

#include "common/base/types.hpp"

namespace tether {

/// Several components over a period as a Fourier series, a_0 + sum_k a_k cos(2 pi k t/T) + b_k sin(2 pi k t/T), fitted
/// to samples by least squares that a few samples far off do not bend: Huber's weights, of 95 % efficiency under normal
/// errors, one weight a sample for all its components. (S.23)
class PeriodicFit {
 public:
  /// values: a column a sample, a row a component; times in any order, at least 2 harmonics + 1 different phases.
  /// Throws InputError if there are fewer.
  PeriodicFit(std::span<const double> times, const MatrixXd& values, double period, int harmonics);

  /// All components at a time.
  VectorXd operator()(double time) const { return coefficients_ * waves(time); }
  /// Root mean square, over samples, of the length of what is left of them; all samples with the same weight.
  double residual() const { return residual_; }

 private:
  VectorXd waves(double time) const;

  double period_;
  int harmonics_;
  MatrixXd coefficients_;
  double residual_ = 0;
};

}  // namespace tether
