#pragma once

#include "vessel/extrude.hpp"
#include "vessel/growth/thickness.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {

/// What a section `grown_wall` says of thickness, of all branches and of single ones.
TreeThickness thickness_of(const GrownWallCase& given);

/// What it says of the growth; the thickness itself is the caller's.
ExtrusionSettings extrusion_of(const GrownWallCase& given);

}  // namespace tether
