#pragma once

#include "common/base/csv.hpp"

/// Measurements come from other programs: their units are stated, never guessed.
namespace tether {

/// Throws InputError if a column's heading has no unit.
void check_unit(const CsvTable& table, const std::string& column, const std::string& example);

/// Of the column `time`, which must have a unit unless its times are fractions of a beat, which have none. Throws
/// InputError.
void check_unit_of_time(const CsvTable& table, bool fractions_of_a_beat);

}  // namespace tether
