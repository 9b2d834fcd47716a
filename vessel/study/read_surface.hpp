#pragma once

#include "vessel/study/study_case.hpp"
#include "vessel/surface/raw_surface.hpp"

namespace tether {

/// The surface of a file in cm, with its labels. Throws InputError if it cannot be read or holds no triangle.
RawSurface read_surface(const SurfaceCase& given);

/// What is wrong with a largest opening of that radius [cm], by the word of the unit that was given: "its largest
/// opening is 401 cm wide in m, which no vessel is; did you mean cm (4.01 cm)". Empty if it may be a vessel's.
std::string wrong_width(double radius, const std::string& unit);

/// Throws InputError if an opening is wider or narrower than any vessel's that is modelled, with the unit that would
/// fit.
void check_unit(const StudyCase& study, double largest_radius);

}  // namespace tether
