#include "diagnosis/search/spread_points.hpp"

#include <algorithm>
#include <limits>

namespace tether {

Points spread(const Points& points, Eigen::Index count) {
  count = std::min(count, points.cols());
  Points chosen(3, count);
  VectorXd distance = VectorXd::Constant(points.cols(), std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    chosen.col(k) = points.col(next);
    distance = distance.cwiseMin((points.colwise() - points.col(next)).colwise().norm().transpose());
    distance.maxCoeff(&next);
  }
  return chosen;
}

}  // namespace tether
