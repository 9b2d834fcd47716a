#include "fsi_master/extrapolation.hpp"

#include <algorithm>
#include <utility>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr double fading = 0.5;    ///< of what earlier steps teach, a step
constexpr double damping = 1e-3;  ///< of the equations for a and b, of their trace
constexpr int scalars = 12;       ///< before the vectors in a packed extrapolation

}  // namespace

void Extrapolation::forget() {
  change_.resize(0);
  before_.resize(0);
  std::fill(std::begin(products_), std::end(products_), 0.0);
  uses_both_ = false;
}

void Extrapolation::follow(RunGuide* guide) {
  guide_ = guide;
  forget();
}

VectorXd Extrapolation::begin(const StepStart& start) {
  const bool was_guided = guided_.size() > 0;
  guided_ = guide_ ? guide_->change_in(start) : VectorXd();
  const bool is_guided = guided_.size() > 0;
  const bool goes_on = std::exchange(ended_, false) && start.dt == dt_ && is_guided == was_guided;
  dt_ = start.dt;
  start_ = start;
  if (!goes_on) forget();
  if (!is_guided) return foreseen();
  return change_.size() > 0 ? VectorXd(guided_ + foreseen()) : guided_;
}

void Extrapolation::end(VectorXd change) {
  if (guide_) guide_->keep(start_, change);
  if (guided_.size() > 0) change = change.size() > 0 ? VectorXd(change - guided_) : VectorXd(-guided_);
  const double squared = change_.size() == change.size() ? change_.squaredNorm() : 0.0;
  if (squared > 0 && before_.size() == change.size()) {
    uses_both_ = (change - by_both()).squaredNorm() < (change - by_share()).squaredNorm();
    const double now[5] = {squared, change_.dot(before_), before_.squaredNorm(), change_.dot(change),
                           before_.dot(change)};
    for (int i = 0; i < 5; ++i) products_[i] = fading * products_[i] + now[i];
    const double extra = damping * (products_[0] + products_[2]), p = products_[0] + extra, q = products_[1],
                 r = products_[2] + extra, determinant = p * r - q * q;
    a_ = (r * products_[3] - q * products_[4]) / determinant;
    b_ = (p * products_[4] - q * products_[3]) / determinant;
  }
  share_ = squared > 0 ? std::clamp(2 * change.dot(change_) / squared - 1, 0.0, 1.0) : 1.0;
  before_ = std::exchange(change_, std::move(change));
  ended_ = true;
}

std::vector<double> Extrapolation::packed() const {
  std::vector<double> values{dt_, share_, ended_ ? 1.0 : 0.0, uses_both_ ? 1.0 : 0.0, a_, b_};
  values.insert(values.end(), std::begin(products_), std::end(products_));
  values.push_back(static_cast<double>(change_.size()));
  values.insert(values.end(), change_.begin(), change_.end());
  values.insert(values.end(), before_.begin(), before_.end());
  return values;
}

void Extrapolation::unpack(const double* begin, const double* end) {
  TETHER_ASSERT(end - begin >= scalars, "a packed extrapolation has {} numbers", end - begin);
  dt_ = begin[0];
  share_ = begin[1];
  ended_ = begin[2] != 0;
  uses_both_ = begin[3] != 0;
  a_ = begin[4];
  b_ = begin[5];
  std::copy_n(begin + 6, 5, products_);
  const auto size = static_cast<Eigen::Index>(begin[scalars - 1]);
  TETHER_ASSERT(end - begin == scalars + size || end - begin == scalars + 2 * size, "{} numbers are no extrapolation",
                end - begin);
  change_ = Eigen::Map<const VectorXd>(begin + scalars, size);
  before_ = Eigen::Map<const VectorXd>(begin + scalars + size, end - begin - scalars - size);
}

}  // namespace tether
