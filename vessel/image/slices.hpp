#pragma once

#include <filesystem>

#include "vessel/image/image_volume.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// Draws nine slices of an image around a surface, three across each of its axes, with the surface's contours in red:
/// what a person looks at to trust a segmentation. Throws RunError if the file cannot be written.
void draw_slices(const std::filesystem::path& png, const ImageVolume& image, const RawSurface& surface);

}  // namespace tether
