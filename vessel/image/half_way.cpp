#include "vessel/image/half_way.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tether {
namespace {

// All in voxels, whatever their sides.
constexpr double from_wall = 1.5;  ///< what is nearer to it is blurred with the other side
constexpr double of_side = 3;      ///< what is farther is not the wall's surroundings any more, in both alike
constexpr int around = 4;          ///< of a voxel, where its two sides are looked for
constexpr double most_moved = 1;

/// Values of voxels around one.
struct Side {
  double sum = 0;
  int count = 0;
  void add(double value) { sum += value, ++count; }
  bool is_known() const { return count >= 4; }  // noise of a tenth of the contrast leaves a twentieth
  double mean() const { return sum / count; }
};

struct Sides {
  Side lumen, outside;
  bool are_known() const { return lumen.is_known() && outside.is_known(); }
  double difference() const { return lumen.mean() - outside.mean(); }
  double half_way() const { return (lumen.mean() + outside.mean()) / 2; }
};

/// Looks for the two sides of a front's voxels.
class Surroundings {
 public:
  explicit Surroundings(const ImageVolume& image) : image_(image) {
    for (int k = -around; k <= around; ++k)
      for (int j = -around; j <= around; ++j)
        for (int i = -around; i <= around; ++i)
          if (i * i + j * j + k * k <= around * around) steps_.push_back({i, j, k});
  }
  /// front: positive in the lumen, a distance from it.
  Sides of(std::size_t n, const std::vector<float>& front) const {
    Sides sides;
    const std::array<int, 3> voxel = image_.voxel(n);
    for (const auto& step : steps_) {
      const std::optional<std::size_t> other = beside(voxel, step);
      if (!other) continue;
      const double distance = front[*other];
      if (std::abs(distance) < from_wall || std::abs(distance) >= of_side) continue;
      (distance > 0 ? sides.lumen : sides.outside).add(image_.values[*other]);
    }
    return sides;
  }

 private:
  /// None beyond the image.
  std::optional<std::size_t> beside(std::array<int, 3> voxel, const std::array<int, 3>& step) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel[axis] += step[axis];
      if (voxel[axis] < 0 || voxel[axis] >= image_.count[axis]) return {};
    }
    return image_.at(voxel[0], voxel[1], voxel[2]);
  }
  const ImageVolume& image_;
  std::vector<std::array<int, 3>> steps_;
};

}  // namespace

void move_half_way(ImageVolume& field, const ImageVolume& image, const std::vector<char>& kept, double contrast,
                   double edge) {
  constexpr int passes = 2;  // a front that lies inward takes some of the lumen for what is outside
  const Surroundings surroundings(image);
  const double width = contrast / (edge * image.spacing.minCoeff());
  const std::vector<float> front = field.values;
  for (int pass = 0; pass < passes; ++pass) {
    const std::vector<float> before = field.values;
    for (std::size_t n = 0; n < front.size(); ++n) {
      const double distance = front[n];
      if (kept[n] || std::abs(distance) >= of_side) continue;
      const Sides sides = surroundings.of(n, before);
      if (!sides.are_known()) continue;
      const double trust = std::clamp(4 * std::abs(sides.difference()) / contrast - 2, 0.0, 1.0),
                   sought = width * (image.values[n] - sides.half_way()) / sides.difference();
      field.values[n] = static_cast<float>(distance + trust * std::clamp(sought - distance, -most_moved, most_moved));
    }
  }
}

}  // namespace tether
