#pragma once

#include <vector>

#include "common/base/types.hpp"
#include "diagnosis/results/gain.hpp"

namespace tether {

/// Paired block bootstrap: blocks (patches of a frame) are drawn with replacement, before and after together, since
/// errors within one are alike. (D.13) precision [1/unit^2], residuals [unit], block: of each datum; count: the number
/// of independent data. At least two blocks.
Gain gain_of(const VectorXd& precision, const std::vector<int>& block, const VectorXd& before, const VectorXd& after,
             double count);
/// The same from each datum's part of the misfit, before and after [n].
Gain gain_in_misfit(const std::vector<int>& block, const VectorXd& before, const VectorXd& after, double count);

}  // namespace tether
