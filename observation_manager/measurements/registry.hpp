#pragma once

#include <span>

#include "observation_manager/measurements/kind.hpp"

namespace tether {

namespace kinds {
extern const MeasurementKind surfaces, contours, traces, velocities;
}

/// What can be measured. A new kind: one file, one name above, one name in registry.cpp.
std::span<const MeasurementKind* const> measurement_kinds();

}  // namespace tether
