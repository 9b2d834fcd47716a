#pragma once

#include <string>

#include "vessel/study/study_case.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// The closed surface [cm] through closed contours, smooth between them as a swept mesh is (cross_sections), in fine
/// triangles: a wall and two flat ends, with the face ids 0, 1 at the first contour and 2 at the last. field: for
/// messages, with its line if known. Throws InputError.
RawSurface surface_through(const LoftCase& given, const std::string& field);

}  // namespace tether
