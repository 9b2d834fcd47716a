#include "vessel/regions.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {

bool WallRegion::contains(double angle, double position) const {
  if (position < position_from || position > position_to) return false;
  if (angle_to - angle_from >= 360) return true;
  const auto turn = [](double degrees) { return degrees - 360 * std::floor(degrees / 360); };
  return turn(angle - angle_from) <= turn(angle_to - angle_from);
}

std::vector<Patch> divide_by_regions(const std::vector<Triangle>& triangles, const std::vector<WallRegion>& regions,
                                     const std::function<WallPlace(const Triangle&)>& place) {
  std::vector<Patch> patches;
  for (const WallRegion& region : regions) patches.push_back({region.name, {}});
  for (const Triangle& triangle : triangles) {
    const WallPlace at = place(triangle);
    const auto found = std::find_if(regions.begin(), regions.end(),
                                    [&](const WallRegion& region) { return region.contains(at.angle, at.position); });
    if (found == regions.end())
      throw input_error(
          "mesh.regions: no region holds the outer wall at angle {:.1f} degrees, position {:.2f}: "
          "end the list with a region without limits",
          at.angle, at.position);
    patches[static_cast<std::size_t>(found - regions.begin())].triangles.push_back(triangle);
  }
  for (const Patch& patch : patches)
    if (patch.triangles.empty())
      throw input_error(
          "mesh.regions.{}: holds no triangle of the outer wall: its limits are too narrow for this mesh, or an "
          "earlier region takes all of it",
          patch.name);
  return patches;
}

}  // namespace tether
