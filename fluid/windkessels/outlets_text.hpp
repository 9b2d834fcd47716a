#pragma once

#include "fluid/windkessels/fit_outlets.hpp"

namespace tether {

/// The tables for a person: pressures asked and reached, elements and flows of each outlet.
std::string text_of(const FittedOutlets& result);

/// outlets.csv: a beat, time by time: pressure where the outlets are joined, flow and stored pressure of each.
void write_beat(const std::filesystem::path& file, const OutletsFit& fit);

/// OUTPUT/plots/outlets.png, from outlets.csv there: pressure over the beat with what was measured, flows of the
/// outlets. Returns whether it was drawn; not without gnuplot.
bool draw_outlets(const std::filesystem::path& output, const OutletsFit& fit);

}  // namespace tether
