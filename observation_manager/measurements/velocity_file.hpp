#pragma once

#include "common/config/case_file.hpp"
#include "observation_manager/measurements/velocities.hpp"
#include "observation_manager/measurements/velocity_series.hpp"

namespace tether {

/// Reads measured velocities (docs/observations.md). Points are numbered as they first occur in the file. Throws
/// InputError "file:line: ...", or naming the field of the case.
VelocitySeries load_velocities(const std::string& name, const VelocitiesCase& given, const CaseFile& file);

}  // namespace tether
