#pragma once

#include "vessel/image/image_case.hpp"
#include "vessel/image/image_volume.hpp"

namespace tether {

/// The image that a study names, in its coordinates, cropped. With labels: 1 where one of them is, 0 elsewhere. Throws
/// InputError for a file that cannot be used, a label that is not there, a crop beside the image.
ImageVolume open_image(const LumenImageCase& how);

}  // namespace tether
