#pragma once

#include "common/base/types.hpp"

namespace tether {

/// So many of the points, the first of them and then each as far as can be from those before; all if there are fewer.
Points spread(const Points& points, Eigen::Index count);

}  // namespace tether
