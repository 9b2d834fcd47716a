#include "fsi_master/extrapolation.hpp"

#include <utility>

#include "common/base/error.hpp"

namespace tether {

VectorXd Extrapolation::begin(double dt) {
  VectorXd change = std::exchange(change_, {});
  return std::exchange(dt_, dt) == dt ? change : VectorXd();
}

std::vector<double> Extrapolation::packed() const {
  std::vector<double> values{dt_};
  values.insert(values.end(), change_.begin(), change_.end());
  return values;
}

void Extrapolation::unpack(const double* begin, const double* end) {
  TETHER_ASSERT(begin < end, "a packed extrapolation has {} numbers", end - begin);
  dt_ = *begin;
  change_ = Eigen::Map<const VectorXd>(begin + 1, end - begin - 1);
}

}  // namespace tether
