#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A function of up to three numbers that is a sum of terms of one and of two of them, at places of each.
struct PairwiseForm {
  std::vector<VectorXd> alone;               ///< of each at its places
  std::vector<std::vector<MatrixXd>> pairs;  ///< [i][j], i < j: at the places of both
  /// With the first at this place of its own: [places of the second x places of the third], one of what there is not.
  MatrixXd at(Eigen::Index first) const;
};

/// Of a set of up to three amplitudes `a`, the logarithm of the probability of data `r` and of `a`, without what `a`
/// does not change: `r` differs from what `a` does by `u = r - y(a)`, which may be wrong by `b e(a)`, `b` normal with
/// deviation 1. (D.19)
struct SetIntegrand {
  PairwiseForm density;  ///< without `e`
  PairwiseForm along;    ///< `e'M u`; empty without `e`
  PairwiseForm size;     ///< `e'M e`
  MatrixXd at(Eigen::Index first) const;
};

/// The logarithm of the integrand summed over all places, and over all others for each place of each amplitude.
struct Summed {
  double all;
  std::vector<VectorXd> each;
};
Summed summed(const SetIntegrand& integrand);

/// Minus infinite of nothing.
double log_sum(const VectorXd& logs);

}  // namespace tether
