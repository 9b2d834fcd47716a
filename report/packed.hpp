#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Numbers in units of `quantum` as little-endian 16-bit integers in base64, column by column; NaN becomes -32768.
/// Throws RunError for a number beyond 32767 quanta.
std::string packed16(const MatrixXd& numbers, double quantum);

/// Whole numbers as little-endian 32-bit integers in base64.
std::string packed32(const std::vector<std::int32_t>& numbers);

}  // namespace tether
