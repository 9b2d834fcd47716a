#pragma once

#include "vessel/study/study_case.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// The surface of a file in cm, with its labels. Throws InputError if it cannot be read or holds no triangle.
RawSurface read_surface(const SurfaceCase& given);

/// Throws InputError if an opening is wider or narrower than any vessel's that is modelled, with the unit that would
/// fit.
void check_unit(const StudyCase& study, double largest_radius);

}  // namespace tether
