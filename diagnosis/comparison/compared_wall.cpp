#include "diagnosis/comparison/compared_wall.hpp"

namespace tether {
namespace {

std::vector<PackedFloats> lines_at(const Moment& moment, const LumenSeries& data, const LumenSurface& lumen,
                                   const RunMotion& run) {
  std::vector<PackedFloats> all;
  for (const SliceView& view : slices_at(moment, data, lumen, run))
    for (const Points& line : view.data) all.push_back(packed(line));
  return all;
}

WallSourceTold told(const SourceDiscrepancy& source, const LumenSeries& data, const LumenSurface& lumen,
                    const RunMotion& run) {
  WallSourceTold result{source.name, source.dimension == 1, {}};
  for (const Moment& moment : source.moments)
    result.moments.push_back({moment.time, moment.held_out, packed(run.positions(moment.time)),
                              packed(distance_at_nodes(moment, data, run).transpose()),
                              lines_at(moment, data, lumen, run)});
  return result;
}

}  // namespace

ComparedWall compared_wall(const std::vector<SourceDiscrepancy>& sources, const Observations& data,
                           const LumenSurface& lumen, const RunMotion& run, const UnitSystem& units) {
  ComparedWall wall;
  wall.units = units.name();
  for (const Triangle& triangle : lumen.triangles)
    wall.triangles.insert(wall.triangles.end(), triangle.begin(), triangle.end());
  wall.regions = lumen.region_names;
  wall.region = lumen.region;
  for (std::size_t i = 0; i < sources.size(); ++i) wall.sources.push_back(told(sources[i], *data.lumen[i], lumen, run));
  return wall;
}

}  // namespace tether
