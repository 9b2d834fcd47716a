#include "vessel/image/half_way.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tether {
namespace {

// All in shortest sides of a voxel.
constexpr double from_wall = 1.5;  ///< what is nearer to it is blurred with the other side
constexpr double of_side = 3;      ///< what is farther is not the wall's surroundings any more
constexpr double around = 4;       ///< of a voxel, where its two sides are looked for
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
    const Vec3 sides = image.spacing / image.spacing.minCoeff();
    const auto reach = [&](Eigen::Index axis) { return static_cast<int>(around / sides[axis]); };
    for (int k = -reach(2); k <= reach(2); ++k)
      for (int j = -reach(1); j <= reach(1); ++j)
        for (int i = -reach(0); i <= reach(0); ++i)
          if (Vec3(i, j, k).cwiseProduct(sides).norm() <= around) steps_.push_back({i, j, k});
  }
  /// front: positive in the lumen, a distance from it.
  Sides of(std::size_t n, const std::vector<float>& front) const {
    Sides sides;
    const std::array<int, 3> voxel = image_.voxel(n);
    for (const auto& step : steps_) {
      const std::optional<std::size_t> other = beside(voxel, step);
      if (!other) continue;
      const double distance = front[*other];
      if (std::abs(distance) < from_wall || distance <= -of_side) continue;
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
  constexpr int passes = 2;  // the sides of a front that lies inward have some of the lumen
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
