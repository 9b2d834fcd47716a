#include "vessel/image/pieces.hpp"

#include <algorithm>
#include <set>

namespace tether {
namespace {

/// Numbers parts that hang together from 1 on; 0: the field is not positive there.
class Parts {
 public:
  explicit Parts(const ImageVolume& field) : field_(field), of_voxel(field.values.size(), 0) {
    for (std::size_t i = 0; i < field.values.size(); ++i)
      if (field.values[i] > 0 && of_voxel[i] == 0) flood(i);
  }

 private:
  void flood(std::size_t first) {
    const auto part = static_cast<int>(sizes.size()) + 1;
    std::size_t size = 0;
    std::vector<std::size_t> border{first};
    of_voxel[first] = part;
    const auto enter = [&](std::size_t i) {
      if (field_.values[i] > 0 && of_voxel[i] == 0) of_voxel[i] = part, border.push_back(i);
    };
    const std::array<std::size_t, 3> step{1, field_.at(0, 1, 0), field_.at(0, 0, 1)};
    for (; !border.empty(); ++size) {
      const std::size_t i = border.back();
      border.pop_back();
      const std::array<int, 3> voxel = field_.voxel(i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (voxel[axis] > 0) enter(i - step[axis]);
        if (voxel[axis] + 1 < field_.count[axis]) enter(i + step[axis]);
      }
    }
    sizes.push_back(size), firsts.push_back(first);
  }
  const ImageVolume& field_;

 public:
  std::vector<int> of_voxel;
  std::vector<std::size_t> sizes, firsts;  ///< of each part: voxels, and one of them
};

}  // namespace

DroppedPieces keep_pieces(ImageVolume& field, const std::vector<std::size_t>& seeds) {
  const Parts parts(field);
  DroppedPieces dropped;
  if (parts.sizes.empty()) return dropped;
  std::set<int> kept;
  for (const std::size_t seed : seeds) kept.insert(parts.of_voxel[seed]);
  if (seeds.empty())
    kept.insert(static_cast<int>(std::max_element(parts.sizes.begin(), parts.sizes.end()) - parts.sizes.begin()) + 1);
  std::size_t largest = 0;
  for (std::size_t part = 0; part < parts.sizes.size(); ++part) {
    if (kept.contains(static_cast<int>(part) + 1)) continue;
    ++dropped.count;
    dropped.volume += static_cast<double>(parts.sizes[part]) * field.spacing.prod();
    if (parts.sizes[part] > largest) largest = parts.sizes[part], dropped.place = field.place(parts.firsts[part]);
  }
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (field.values[i] > 0 && !kept.contains(parts.of_voxel[i])) field.values[i] = -field.values[i];
  return dropped;
}

}  // namespace tether
