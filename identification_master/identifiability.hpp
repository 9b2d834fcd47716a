#pragma once

#include "common/base/types.hpp"

namespace tether {

/// What the data said about each combination of parameters, in units of the prior. (K.7)
struct Identifiability {
  MatrixXd gramian;      ///< P0^1/2 (P^-1 - P0^-1) P0^1/2: the data's information, in prior deviations of theta
  VectorXd information;  ///< its eigenvalues, largest first: the prior's variance over the
                         ///< data's
  MatrixXd directions;   ///< their eigenvectors, one a column, in prior deviations of theta
  VectorXd retained;     ///< of each parameter: share of its information that the others do not explain away; 0 if the
                         ///< data alone would lower its deviation by less than 5 %
};

/// From the covariances of theta before and after the data.
Identifiability identifiability(const MatrixXd& prior, const MatrixXd& posterior);

/// Correlations of a covariance.
MatrixXd correlations(const MatrixXd& covariance);

}  // namespace tether
