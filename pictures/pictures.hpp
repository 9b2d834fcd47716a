#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/units.hpp"

namespace tether {

/// Draws the wall where its lumen moved farthest, coloured by its displacement, and the blood at its fastest, opened
/// along the middle: OUTPUT/plots/wall.png, blood.png, from the files of the series that are nearest in time. Returns
/// the names of the pictures; none if there is no X server (Xvfb) or no series.
std::vector<std::string> draw_pictures(const std::filesystem::path& output, const UnitSystem& units);

/// Whether pictures are to be drawn: Xvfb is installed, and TETHER_PICTURES in the environment is not 0.
bool has_display_server();

/// Runs tether_picture MESH PNG with these options. Returns whether it drew; if not, says why on stderr.
bool draw_picture(const std::filesystem::path& mesh, const std::filesystem::path& png,
                  const std::vector<std::string>& options);

}  // namespace tether
