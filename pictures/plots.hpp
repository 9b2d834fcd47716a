#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/units.hpp"

namespace tether {

/// Draws the columns of OUTPUT/timeseries.csv over time, in mmHg, ml/s, mm and N: OUTPUT/plots/pressures.png,
/// flows.png, ... `image_pressure`: to which the table's pressures are relative. The gnuplot script stays beside them.
/// Returns the names of the pictures; none if gnuplot is not installed. Throws RunError if it fails.
std::vector<std::string> draw_plots(const std::filesystem::path& output, const UnitSystem& units,
                                    double image_pressure);

}  // namespace tether
