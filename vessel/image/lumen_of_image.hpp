#pragma once

#include "vessel/image/image_case.hpp"
#include "vessel/image/image_summary.hpp"
#include "vessel/image/image_volume.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// The lumen's surface, outward, open where the lumen leaves the image.
struct LumenOfImage {
  RawSurface surface;
  ImageSummary summary;
};

/// The lumen of an image as the study tells it from the rest: by label, threshold or level set; the part that holds the
/// seeds, or the largest. With labels, the image is 1 where they are (open_image). Throws InputError with the study's
/// line for a threshold beyond the values, a seed outside the image or the lumen.
LumenOfImage lumen_of(const ImageVolume& image, const LumenImageCase& how);

/// Throws InputError for a lumen wider than any vessel: it leaks.
void check_width(const ImageSummary& summary, const LumenImageCase& how);

}  // namespace tether
