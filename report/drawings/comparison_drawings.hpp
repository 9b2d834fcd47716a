#pragma once

#include "diagnosis/comparison/comparison.hpp"
#include "diagnosis/comparison/slices.hpp"

namespace tether {

/// A comparison with what it was made from, to be drawn into OUTPUT/plots.
struct DrawnComparison {
  const Comparison& comparison;
  const Observations& data;
  const LumenSurface& lumen;
  const RunMotion& run;
  std::filesystem::path output;
};

/// Per source the distances of each region over time, beside the data's own motion, and each trace:
/// comparison_SOURCE.png, trace_NAME.png, velocity_NAME.png. Returns the names; none without gnuplot.
std::vector<std::string> draw_distances(const DrawnComparison& drawn);

/// Model and data over each other in every slice, at the worst moment and at that of the largest lumen:
/// contours_SOURCE_SLICE.png.
std::vector<std::string> draw_slices(const DrawnComparison& drawn);

/// The lumen at these moments coloured by the signed distance, the data as lines: wall_SOURCE_worst.png,
/// wall_SOURCE_fullest.png, from OUTPUT/comparison/*.vtu and .vtp. None without a display.
std::vector<std::string> draw_walls(const DrawnComparison& drawn);

/// Letters and digits of a name, the rest as underscores.
std::string file_name(const std::string& name);

}  // namespace tether
