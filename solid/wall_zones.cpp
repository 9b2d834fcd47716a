#include "solid/wall_zones.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "vessel/regions.hpp"

namespace tether {
namespace {

/// Places between 0 and 1 where the effects that act in a region begin or end.
std::set<double> borders_in(int region, const std::vector<LocalEffect>& effects) {
  std::set<double> borders;
  for (const LocalEffect& effect : effects)
    if (std::count(effect.regions.begin(), effect.regions.end(), region) > 0)
      for (const double border : {effect.extent.from, effect.extent.to})
        if (border > 0 && border < 1) borders.insert(border);
  return borders;
}

/// How near a region's nodes are to each of the neighbours toward which its effects act.
std::map<std::string, VectorXd> neighbours_in(int region, const std::vector<LocalEffect>& effects,
                                              const WallMesh& mesh) {
  std::map<std::string, VectorXd> neighbours;
  const std::string& name = mesh.outside[static_cast<std::size_t>(region)].name;
  for (const LocalEffect& effect : effects) {
    const std::string& toward = effect.extent.toward;
    if (toward.empty() || std::count(effect.regions.begin(), effect.regions.end(), region) == 0) continue;
    if (VectorXd& near = neighbours[toward]; near.size() == 0) near = nearness(toward, name, mesh.outside, mesh.points);
  }
  return neighbours;
}

/// Appends the zone's parts toward each of the neighbours, and what is toward none of them.
void add_parts(WallZone zone, const std::map<std::string, VectorXd>& neighbours, std::vector<WallZone>& zones) {
  for (const auto& [name, near] : neighbours) {
    zones.push_back({part_between(zone.patch, near, 0, 1), zone.region, {zone.extent.from, zone.extent.to, name}});
    zone.patch = part_between(zone.patch, near, -1, 0);
    if (zone.patch.parts.empty()) return;
  }
  zones.push_back(std::move(zone));
}

/// Those that limit effects which act in a region, each once.
std::vector<Ball> balls_in(int region, const std::vector<LocalEffect>& effects) {
  std::vector<Ball> balls;
  for (const LocalEffect& effect : effects)
    if (effect.extent.about && std::count(effect.regions.begin(), effect.regions.end(), region) > 0 &&
        std::count(balls.begin(), balls.end(), *effect.extent.about) == 0)
      balls.push_back(*effect.extent.about);
  return balls;
}

/// Zones of a region, cut where they leave the ball.
void divide_by(const Ball& ball, int region, const Points& points, std::vector<WallZone>& zones) {
  const std::size_t count = zones.size();
  for (std::size_t z = 0; z < count; ++z) {
    if (zones[z].region != region) continue;
    NearAndFar sides = divided_by_distance(zones[z].patch, points, ball.centre, ball.radius);
    if (sides.near.parts.empty()) continue;
    if (!sides.far.parts.empty()) {
      WallZone beyond = zones[z];
      beyond.patch = std::move(sides.far);
      zones.push_back(std::move(beyond));
    }
    zones[z].patch = std::move(sides.near);
    zones[z].within.push_back(ball);
  }
}

}  // namespace

std::vector<WallZone> wall_zones(const WallMesh& mesh, const std::vector<LocalEffect>& effects, const VectorXd& along) {
  std::vector<WallZone> zones;
  for (std::size_t r = 0; r < mesh.outside.size(); ++r) {
    const auto region = static_cast<int>(r);
    const std::map<std::string, VectorXd> neighbours = neighbours_in(region, effects, mesh);
    std::set<double> ends = borders_in(region, effects);
    if (ends.empty()) {
      add_parts({mesh.outside[r], region, {}}, neighbours, zones);
      continue;
    }
    ends.insert(1);
    double from = 0;
    for (const double to : ends) {
      add_parts({part_between(mesh.outside[r], along, from, to), region, {from, to}}, neighbours, zones);
      from = to;
    }
  }
  for (std::size_t r = 0; r < mesh.outside.size(); ++r)
    for (const Ball& ball : balls_in(static_cast<int>(r), effects))
      divide_by(ball, static_cast<int>(r), mesh.points, zones);
  return zones;
}

bool acts_in(const LocalEffect& effect, const WallZone& zone) {
  return std::count(effect.regions.begin(), effect.regions.end(), zone.region) > 0 &&
         effect.extent.from <= zone.extent.from && zone.extent.to <= effect.extent.to &&
         (effect.extent.toward.empty() || effect.extent.toward == zone.extent.toward) &&
         (!effect.extent.about || std::count(zone.within.begin(), zone.within.end(), *effect.extent.about) > 0);
}

}  // namespace tether
