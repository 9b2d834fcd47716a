#include "solid/wall_zones.hpp"

#include <algorithm>
#include <set>

#include "vessel/regions.hpp"

namespace tether {
namespace {

/// Places between 0 and 1 where the effects that act in a region begin or end.
std::set<double> borders_in(int region, const std::vector<LocalEffect>& effects) {
  std::set<double> borders;
  for (const LocalEffect& effect : effects)
    if (std::count(effect.regions.begin(), effect.regions.end(), region) > 0)
      for (const double border : {effect.band.from, effect.band.to})
        if (border > 0 && border < 1) borders.insert(border);
  return borders;
}

}  // namespace

std::vector<WallZone> wall_zones(const WallMesh& mesh, const std::vector<LocalEffect>& effects, const VectorXd& along) {
  std::vector<WallZone> zones;
  for (std::size_t r = 0; r < mesh.outside.size(); ++r) {
    const auto region = static_cast<int>(r);
    std::set<double> ends = borders_in(region, effects);
    if (ends.empty()) {
      zones.push_back({mesh.outside[r], region, {}});
      continue;
    }
    ends.insert(1);
    double from = 0;
    for (const double to : ends) {
      zones.push_back({part_between(mesh.outside[r], along, from, to), region, {from, to}});
      from = to;
    }
  }
  return zones;
}

bool acts_in(const LocalEffect& effect, const WallZone& zone) {
  return std::count(effect.regions.begin(), effect.regions.end(), zone.region) > 0 &&
         effect.band.from <= zone.band.from && zone.band.to <= effect.band.to;
}

}  // namespace tether
