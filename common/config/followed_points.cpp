#include "common/config/followed_points.hpp"

#include <cmath>

#include "common/base/error.hpp"

namespace tether {

void check_followed(const CaseFile& file, const Points& lumen) {
  const double size = (lumen.rowwise().maxCoeff() - lumen.rowwise().minCoeff()).norm();
  for (const auto& [name, point] : file.common().output.points) {
    const double distance = std::sqrt((lumen.colwise() - point).colwise().squaredNorm().minCoeff());
    if (distance > 0.1 * size)
      throw input_error("{}: the nearest node of the lumen is {:.4g} away (the vessel's diagonal is {:.4g})",
                        file.where("output.points." + name), distance, size);
  }
}

}  // namespace tether
