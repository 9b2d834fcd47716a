#include "vessel/image/stops.hpp"

#include <algorithm>
#include <cmath>

namespace tether {

void for_stops(const ImageVolume& image, const Named<StopCase>& stops,
               const std::function<void(std::size_t voxel, double outside)>& visit) {
  for (const auto& [name, stop] : stops) {
    const Vec3 middle = image.index(stop.point);
    const Vec3 half = (Vec3::Constant(stop.radius).cwiseQuotient(image.spacing).array() + 1).matrix();
    std::array<int, 3> low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<int>(axis);
      low[axis] = std::max(0, static_cast<int>(std::ceil(middle[i] - half[i])));
      high[axis] = std::min(image.count[axis] - 1, static_cast<int>(std::floor(middle[i] + half[i])));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          visit(image.at(i, j, k), (image.place(Vec3(i, j, k)) - stop.point).norm() - stop.radius);
  }
}

void cut_out(ImageVolume& field, const Named<StopCase>& stops) {
  const auto [least, most] = std::minmax_element(field.values.begin(), field.values.end());
  const double slope = std::max(-*least, *most) / field.spacing.minCoeff();  // the field itself is not steeper
  for_stops(field, stops, [&](std::size_t n, double outside) {
    field.values[n] = std::min(field.values[n], static_cast<float>(slope * outside));
  });
}

}  // namespace tether
