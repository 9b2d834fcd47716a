#include "fsi_master/extrapolation.hpp"

#include <algorithm>
#include <utility>

#include "common/base/error.hpp"

namespace tether {

VectorXd Extrapolation::begin(double dt) {
  const bool goes_on = std::exchange(ended_, false) && dt == dt_;
  dt_ = dt;
  if (!goes_on) change_.resize(0);
  return share_ * change_;
}

void Extrapolation::end(VectorXd change) {
  const double squared = change_.size() == change.size() ? change_.squaredNorm() : 0.0;
  share_ = squared > 0 ? std::clamp(2 * change.dot(change_) / squared - 1, 0.0, 1.0) : 1.0;
  change_ = std::move(change);
  ended_ = true;
}

std::vector<double> Extrapolation::packed() const {
  std::vector<double> values{dt_, share_, ended_ ? 1.0 : 0.0};
  values.insert(values.end(), change_.begin(), change_.end());
  return values;
}

void Extrapolation::unpack(const double* begin, const double* end) {
  TETHER_ASSERT(end - begin >= 3, "a packed extrapolation has {} numbers", end - begin);
  dt_ = begin[0];
  share_ = begin[1];
  ended_ = begin[2] != 0;
  change_ = Eigen::Map<const VectorXd>(begin + 3, end - begin - 3);
}

}  // namespace tether
