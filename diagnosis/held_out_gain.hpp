#pragma once

#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// By how much a change of the model lessens the distance to data, 1 - rms after/rms before, with a 95 % interval.
struct Gain {
  double value = 0, lower = 0, upper = 0;
  double before = 0, after = 0;  ///< root of the mean square, in the noise's deviation
  double positive = 0;           ///< probability that there is any
};

/// Paired block bootstrap: blocks (patches of a frame) are drawn with replacement, before and after together, since
/// errors within one are alike. (D.13) precision [1/unit^2], residuals [unit], block: of each datum; count: the number
/// of independent data. At least two blocks.
Gain gain_of(const VectorXd& precision, const std::vector<int>& block, const VectorXd& before, const VectorXd& after,
             double count);
/// The same from each datum's part of the misfit, before and after [n].
Gain gain_in_misfit(const std::vector<int>& block, const VectorXd& before, const VectorXd& after, double count);

}  // namespace tether
