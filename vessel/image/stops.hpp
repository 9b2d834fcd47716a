#pragma once

#include <functional>

#include "vessel/image/image_case.hpp"
#include "vessel/image/image_volume.hpp"

namespace tether {

/// Calls `visit(voxel, outside)` for the voxels in and next to each stop's ball, with the distance from its surface
/// [cm], negative within.
void for_stops(const ImageVolume& image, const Named<StopCase>& stops,
               const std::function<void(std::size_t voxel, double outside)>& visit);

/// Makes a field negative in the balls of the stops.
void cut_out(ImageVolume& field, const Named<StopCase>& stops);

}  // namespace tether
