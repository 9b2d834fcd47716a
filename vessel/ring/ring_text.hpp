#pragma once

#include <filesystem>

#include "vessel/ring/tracked_ring.hpp"

namespace tether {

/// For a person: how far the ring goes and tilts, and how wide it is.
std::string text_of(const TrackedRing& ring);

/// A table of poses that `solid.rings.NAME.motion` reads with `table: poses`.
void write_poses(const std::filesystem::path& file, const TrackedRing& ring);

/// OUTPUT/plots/ring.png from poses.csv there: the centre's way, the turn and the radius over time. Returns whether it
/// was drawn; not without gnuplot.
bool draw_ring(const std::filesystem::path& output);

}  // namespace tether
