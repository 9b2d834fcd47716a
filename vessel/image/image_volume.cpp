#include "vessel/image/image_volume.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tether {

std::array<int, 3> ImageVolume::voxel(std::size_t number) const {
  const auto nx = static_cast<std::size_t>(count[0]), ny = static_cast<std::size_t>(count[1]);
  return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny), static_cast<int>(number / (nx * ny))};
}

Vec3 ImageVolume::place(std::size_t number) const {
  const auto [i, j, k] = voxel(number);
  return place(Vec3(i, j, k));
}

bool ImageVolume::holds(const Vec3& place) const {
  const Vec3 at = index(place);
  for (int axis = 0; axis < 3; ++axis)
    if (!(at[axis] >= -0.5 && at[axis] <= count[static_cast<std::size_t>(axis)] - 0.5)) return false;
  return true;
}

std::size_t ImageVolume::nearest(const Vec3& place) const {
  const Vec3 at = index(place);
  std::array<int, 3> voxel{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    voxel[axis] = std::clamp(static_cast<int>(std::lround(at[static_cast<int>(axis)])), 0, count[axis] - 1);
  return this->at(voxel[0], voxel[1], voxel[2]);
}

std::string ImageVolume::extent() const {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = corner >> axis & 1 ? count[static_cast<std::size_t>(axis)] - 0.5 : -0.5;
    low = low.cwiseMin(place(at)), high = high.cwiseMax(place(at));
  }
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) cm", low[0], low[1], low[2], high[0],
                     high[1], high[2]);
}

}  // namespace tether
