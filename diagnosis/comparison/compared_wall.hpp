#pragma once

#include "diagnosis/comparison/slices.hpp"
#include "diagnosis/results/compared_wall.hpp"

namespace tether {

/// What wall.json says of a run that was compared. `sources`: as compared with each of `data`, in their order.
ComparedWall compared_wall(const std::vector<SourceDiscrepancy>& sources, const Observations& data,
                           const LumenSurface& lumen, const RunMotion& run, const UnitSystem& units);

}  // namespace tether
