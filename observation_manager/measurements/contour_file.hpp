#pragma once

#include "common/base/units.hpp"
#include "observation_manager/measurements/contour_series.hpp"
#include "observation_manager/measurements/contours.hpp"

namespace tether {

/// Contours over time from a table with a row for each point: slice, frame, time, x, y, z, and, where a slice has
/// several contours or open ones, contour (a name) and closed (1 or 0). In the case's units. The tracks of a slice lie
/// in one plane, fitted to all its points; `notes` tells what was left out. Throws InputError "file:line: ...": no
/// unit, one of times that are fractions, unknown slices or held-out frames, rows of a contour apart, frames without
/// one time or of equal times, too few points, a slice that is not flat, a contour that crosses itself.
std::vector<ContourTrack> read_contour_tracks(const SlicesCase& given, const UnitSystem& units,
                                              std::vector<Note>& notes);

}  // namespace tether
