#pragma once

#include "common/base/types.hpp"

namespace tether {

/// The unitary simplex: p + 1 points in p dimensions, one a column [p x (p+1)], with sum I_i = 0 and
/// sum I_i I_i'/(p+1) = 1; all lie sqrt(p) from the origin. (K.2)
MatrixXd simplex_points(int p);

}  // namespace tether
