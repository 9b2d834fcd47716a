#include "vessel/grown_wall.hpp"

namespace tether {
namespace {

Thickness thickness_of(const ThicknessCase& given) {
  return {given.thickness, given.fraction_of_radius};
}

}  // namespace

TreeThickness thickness_of(const GrownWallCase& given) {
  TreeThickness tree{thickness_of(given.thickness), {}, given.blend};
  for (const auto& [name, own] : given.branches) tree.branches.emplace_back(name, thickness_of(own));
  return tree;
}

ExtrusionSettings extrusion_of(const GrownWallCase& given) {
  ExtrusionSettings settings;
  settings.layers = given.layers;
  settings.smoothing = given.smoothing;
  settings.least_share = given.least_share;
  return settings;
}

}  // namespace tether
