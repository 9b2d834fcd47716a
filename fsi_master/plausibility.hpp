#pragma once

#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "common/protocol/messages.hpp"

namespace tether {

/// A sentence for each announced number that no blood or vessel has, such as a density of 1060 g/cm3: most often a
/// mistake of units. Numbers without a usual range are passed over.
std::vector<std::string> unusual_numbers(const std::vector<protocol::ParameterInfo>& parameters,
                                         const UnitSystem& units);

/// The same of the pressure in the image; empty if it is usual, or zero.
std::string unusual_image_pressure(double pressure, const UnitSystem& units);

}  // namespace tether
