#include "fsi_master/difference_columns.hpp"

#include <algorithm>

#include "common/base/error.hpp"

namespace tether {

void DifferenceColumns::begin_step() {
  steps_.emplace_front();
  while (static_cast<int>(steps_.size()) > reuse_ + 1) steps_.pop_back();
}

void DifferenceColumns::add(VectorXd dR, VectorXd dX) {
  steps_.front().push_front({std::move(dR), std::move(dX)});
}

bool DifferenceColumns::empty() const {
  return std::all_of(steps_.begin(), steps_.end(), [](const auto& pairs) { return pairs.empty(); });
}

VectorXd DifferenceColumns::correction(const VectorXd& residual) {
  std::vector<VectorXd> q;  // orthonormal directions of dR
  std::vector<VectorXd> x;  // the combinations of dX that belong to them
  for (auto& pairs : steps_) {
    std::erase_if(pairs, [&](const Pair& pair) {
      VectorXd rest = pair.dR, image = pair.dX;
      for (std::size_t i = 0; i < q.size(); ++i) {
        const double share = q[i].dot(rest);
        rest -= share * q[i];
        image -= share * x[i];
      }
      const double length = rest.norm();
      if (!(length > filter_ * pair.dR.norm())) return true;
      q.push_back(rest / length);
      x.push_back(image / length);
      return false;
    });
  }
  VectorXd sum = VectorXd::Zero(residual.size());
  for (std::size_t i = 0; i < q.size(); ++i) sum -= q[i].dot(residual) * x[i];
  return sum;
}

std::vector<double> DifferenceColumns::packed() const {
  std::vector<double> values{static_cast<double>(steps_.size())};
  for (const auto& pairs : steps_) {
    values.push_back(static_cast<double>(pairs.size()));
    for (const auto& pair : pairs) {
      values.push_back(static_cast<double>(pair.dR.size()));
      values.insert(values.end(), pair.dR.begin(), pair.dR.end());
      values.insert(values.end(), pair.dX.begin(), pair.dX.end());
    }
  }
  return values;
}

void DifferenceColumns::unpack(const double* begin, const double* end) {
  const double* next = begin;
  const auto count = [&] {
    TETHER_ASSERT(next < end, "columns end after {} numbers", end - begin);
    return static_cast<Eigen::Index>(*next++);
  };
  const auto vector = [&](Eigen::Index size) {
    TETHER_ASSERT(end - next >= size, "columns end after {} numbers", end - begin);
    next += size;
    return VectorXd(Eigen::Map<const VectorXd>(next - size, size));
  };
  steps_.assign(static_cast<std::size_t>(count()), {});
  for (auto& pairs : steps_) {
    for (Eigen::Index left = count(); left > 0; --left) {
      const Eigen::Index size = count();
      VectorXd dR = vector(size);
      pairs.push_back({std::move(dR), vector(size)});
    }
  }
}

}  // namespace tether
