#pragma once

#include "diagnosis/comparison/comparison.hpp"
#include "diagnosis/results/comparison.hpp"

namespace tether {

/// What comparison.json says, in the case's units.
ComparisonResult result_of(const Comparison& comparison);

}  // namespace tether
