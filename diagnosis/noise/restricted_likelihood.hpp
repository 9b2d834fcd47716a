#pragma once

#include "diagnosis/noise/noise_field.hpp"
#include "diagnosis/results/noise.hpp"

namespace tether {

/// Correlation of errors `apart`, without the nugget. length: above 0, in the same unit.
double correlation_at(double apart, double length, CorrelationShape shape);

/// Of noise of deviation 1: logarithm of the determinants, and what is left of the data, each squared over its variance
/// (D.23).
struct RestrictedSums {
  double log_determinant = 0, squares = 0;
};

/// How probable data are with a noise, whatever the amplitudes of the free columns are: restricted likelihood
/// (Patterson and Thompson, Biometrika 58, 1971). (D.23)
class RestrictedLikelihood {
 public:
  /// Columns that say nothing new are left out.
  explicit RestrictedLikelihood(std::vector<NoiseField> fields);

  /// Of one shape and length: data along the eigenvectors of the correlation, so that nuggets cost little.
  class Slice {
   public:
    RestrictedSums at(double nugget) const;

   private:
    friend class RestrictedLikelihood;
    struct Turned {
      VectorXd variances;            ///< of the waves [n]
      MatrixXd free;                 ///< [n x p]
      std::vector<MatrixXd> frames;  ///< shared columns, then the values [n x k + 1]
    };
    std::vector<Turned> fields_;
    Eigen::Index shared_ = 0;
  };
  Slice slice(CorrelationShape shape, double length) const;

  double log_likelihood(const RestrictedSums& sums, double deviation) const;
  /// With the deviation that fits best.
  double log_likelihood(const RestrictedSums& sums) const;
  /// Data less columns.
  Eigen::Index count() const { return count_; }
  const std::vector<NoiseField>& fields() const { return fields_; }

 private:
  std::vector<NoiseField> fields_;
  Eigen::Index count_ = 0, shared_ = 0;
};

}  // namespace tether
