#pragma once

#include "vessel/study/study_case.hpp"
#include "vessel/surface/rims.hpp"
#include "vessel/surface/surface.hpp"

namespace tether {

/// Opens a repaired surface where the study says its ends are: takes labelled ends off, cuts by planes, and takes flat
/// ends off where nothing else makes an opening; fills rims that are none; makes the others flat. Returns the middle of
/// each opening, in the study's order. Throws InputError, PlacedError for a rim too large to be a hole.
std::vector<Vec3> open_ends(Repaired& state, const StudyCase& study);

/// The rim of each opening, by the middles of open_ends.
std::vector<Rim> rims_at(const RawSurface& surface, const std::vector<Vec3>& middles);

/// With flat caps in all its openings.
LabelledSurface capped(RawSurface surface, const std::vector<Vec3>& middles, const StudyCase& study);

}  // namespace tether
