#pragma once

#include "vessel/image/image_volume.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// The surface on which a field is zero, linear between middles of voxels; triangles face to where it is negative. Open
/// where the positive part reaches the outermost voxels.
RawSurface zero_surface(const ImageVolume& field);

}  // namespace tether
