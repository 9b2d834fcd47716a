#include "vessel/image/basins.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

/// Voxels that wait, by level; of one level, the one that came first. A level that has passed counts as the present.
class Waiting {
 public:
  void push(std::size_t voxel, std::size_t level) { levels_[std::max(level, now_)].push_back(voxel); }
  /// Whether there is one, which goes to `voxel`.
  bool pop(std::size_t& voxel) {
    while (next_ == levels_[now_].size()) {
      levels_[now_] = {}, next_ = 0;
      if (++now_ == levels_.size()) return false;
    }
    voxel = levels_[now_][next_++];
    return true;
  }
  static constexpr std::size_t count = 1024;

 private:
  std::vector<std::vector<std::size_t>> levels_ = std::vector<std::vector<std::size_t>>(count);
  std::size_t now_ = 0, next_ = 0;
};

}  // namespace

ImageVolume neighbours_basin(const ImageVolume& gradient, const std::vector<std::size_t>& seeds,
                             const std::vector<std::size_t>& neighbours) {
  constexpr char lumen = 1, neighbour = 2;
  const float most = *std::max_element(gradient.values.begin(), gradient.values.end());
  std::vector<char> owner(gradient.values.size(), 0);
  Waiting waiting;
  const auto take = [&](std::size_t n, char by) {
    if (owner[n] != 0) return;
    owner[n] = by;
    // finer where values change little: noise and a weak edge differ there
    waiting.push(n, static_cast<std::size_t>((Waiting::count - 1) * std::sqrt(gradient.values[n] / most)));
  };
  for (const std::size_t n : seeds) take(n, lumen);
  for (const std::size_t n : neighbours) take(n, neighbour);
  const std::array<std::size_t, 3> stride{1, gradient.at(0, 1, 0), gradient.at(0, 0, 1)};
  for (std::size_t n = 0; waiting.pop(n);) {
    const std::array<int, 3> voxel = gradient.voxel(n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (voxel[axis] > 0) take(n - stride[axis], owner[n]);
      if (voxel[axis] + 1 < gradient.count[axis]) take(n + stride[axis], owner[n]);
    }
  }
  ImageVolume basin = gradient;
  std::transform(owner.begin(), owner.end(), basin.values.begin(),
                 [](char by) { return by == neighbour ? 1.0F : 0.0F; });
  return basin;
}

}  // namespace tether
