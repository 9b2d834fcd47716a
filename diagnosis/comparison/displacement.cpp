#include "diagnosis/comparison/displacement.hpp"

#include <algorithm>
#include <cmath>

namespace tether {

double displacement_between(const FinishedMotion& run, const FinishedMotion& other, const LumenSurface& lumen,
                            const std::vector<double>& times) {
  const VectorXd area = nodal_areas(lumen);
  double most = 0;
  for (const double time : times) {
    const Points apart = run.motion.positions(time) - other.motion.positions(time);
    most = std::max(most, apart.colwise().squaredNorm().dot(area) / area.sum());
  }
  return std::sqrt(most);
}

}  // namespace tether
