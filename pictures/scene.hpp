#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tether {

/// One picture of a mesh coloured by a field, from two sides.
struct Scene {
  std::filesystem::path mesh;                      ///< .vtu or .vtp
  std::string field;                               ///< of points or cells; of a vector the magnitude; grey where NaN
  std::string title;                               ///< above the colours, unit included
  double factor = 1;                               ///< from the file's unit to the title's
  std::optional<std::pair<double, double>> range;  ///< of the colours, in the title's unit; absent: that of the field
  bool diverging = false;          ///< blue, white, red around the range's middle; else from dark to bright
  std::vector<std::string> names;  ///< of the values 0, 1, 2 ... of a field that numbers things; none: numbers
  std::string warp;                ///< field of points by which the mesh is displaced; empty: not
  double warp_scale = 1;
  bool cut = false;             ///< show the inside: the half that faces the viewer is taken away
  std::filesystem::path lines;  ///< .vtp with polylines drawn over it (measured contours); empty: none
  int width = 1400, height = 800;
};

/// Renders the scene into a PNG file; needs an X display. Throws InputError for a file or field that is not there.
void draw(const Scene& scene, const std::filesystem::path& png);

}  // namespace tether
