#include "report/wall.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/observation/observed_case.hpp"
#include "report/packed.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

/// Finished runs against one source.
class SourceWall {
 public:
  SourceWall(const LumenSeries& data, const LumenSurface& lumen, const std::vector<RunMotion>& runs)
      : data_(data), lumen_(lumen), runs_(runs) {
    for (const RunMotion& run : runs) compared_.push_back(compare(data, lumen.region_names, run));
  }

  WallSource source() const {
    WallSource result{compared_.front().name, compared_.front().dimension == 1, {}};
    for (const Moment& moment : compared_.front().moments)
      if (auto found = everywhere(moment); found.size() == runs_.size()) result.moments.push_back(moment_of(found));
    return result;
  }

 private:
  /// The same moment in each run that reaches it.
  std::vector<const Moment*> everywhere(const Moment& moment) const {
    std::vector<const Moment*> all;
    for (const SourceDiscrepancy& run : compared_) {
      const auto found = std::find_if(run.moments.begin(), run.moments.end(), [&](const Moment& other) {
        return other.held_out == moment.held_out && std::abs(other.time - moment.time) < 1e-9;
      });
      if (found != run.moments.end()) all.push_back(&*found);
    }
    return all;
  }

  WallMoment moment_of(const std::vector<const Moment*>& in_runs) const {
    WallMoment result{in_runs.front()->time, in_runs.front()->held_out, {}, {}};
    for (const SliceView& view : slices_at(*in_runs.front(), data_, lumen_, runs_.front()))
      result.data.insert(result.data.end(), view.data.begin(), view.data.end());
    for (std::size_t i = 0; i < runs_.size(); ++i)
      result.states.push_back({runs_[i].positions(in_runs[i]->time), distance_at_nodes(*in_runs[i], data_, runs_[i]),
                               group_of_region(*in_runs[i], -1)->model.rms});
    return result;
  }

  const LumenSeries& data_;
  const LumenSurface& lumen_;
  const std::vector<RunMotion>& runs_;
  std::vector<SourceDiscrepancy> compared_;
};

RunMotion motion_on(const LumenSurface& lumen, const std::filesystem::path& folder) {
  RunMotion motion = stored_motion(folder);
  if (motion.imaged.cols() != lumen.points.cols())
    throw input_error("{}: its {} nodes are not the {} of the case's mesh", (folder / "lumen.motion").string(),
                      motion.imaged.cols(), lumen.points.cols());
  return motion;
}

/// How lengths become 16-bit integers: in mm from the middle of everything drawn.
struct Grid {
  Vec3 centre;             ///< [mm]
  double place, distance;  /// quanta of both [mm]
};

Grid grid_of(const Wall& wall, double mm) {
  Vec3 low = Vec3::Constant(infinite), high = -low;
  double farthest = 0;
  const auto include = [&](const Points& points) {
    if (points.cols() == 0) return;
    low = low.cwiseMin(mm * points.rowwise().minCoeff());
    high = high.cwiseMax(mm * points.rowwise().maxCoeff());
  };
  for (const WallSource& source : wall.sources)
    for (const WallMoment& moment : source.moments) {
      for (const Points& line : moment.data) include(line);
      for (const WallState& state : moment.states) {
        include(state.positions);
        for (const double d : state.distances)
          if (std::isfinite(d)) farthest = std::max(farthest, mm * std::abs(d));
      }
    }
  const double steps = 32000;
  return {(low + high) / 2, std::max(1e-6, (high - low).maxCoeff() / 2 / steps), std::max(1e-6, farthest / steps)};
}

std::string places(const Points& points, const Grid& grid, double mm) {
  return packed16((mm * points).colwise() - grid.centre, grid.place);
}

Json moment_json(const WallMoment& moment, const Grid& grid, double mm) {
  Json json{{"time", moment.time}, {"held_out", moment.held_out}, {"lines", Json::array()}, {"states", Json::array()}};
  for (const Points& line : moment.data) json["lines"].push_back(places(line, grid, mm));
  for (const WallState& state : moment.states)
    json["states"].push_back({{"positions", places(state.positions, grid, mm)},
                              {"distances", packed16(mm * state.distances, grid.distance)}});
  return json;
}

}  // namespace

Wall wall_of(const std::filesystem::path& case_file, const std::vector<std::filesystem::path>& runs) {
  ObservedCase given(case_file);
  const LumenSurface lumen = given.lumen();
  const Observations data = load_observations(given.observations, lumen, given.file);
  std::vector<RunMotion> motions;
  for (const auto& folder : runs) motions.push_back(motion_on(lumen, folder));
  Wall wall{lumen.triangles, lumen.region_names, lumen.region, given.file.units(), {}};
  for (const auto& source : data.lumen) wall.sources.push_back(SourceWall(*source, lumen, motions).source());
  return wall;
}

std::string json_of(const Wall& wall) {
  const double mm = wall.units.to_mm(1);
  const Grid grid = grid_of(wall, mm);
  std::vector<std::int32_t> corners, regions(wall.region.begin(), wall.region.end());
  for (const Triangle& triangle : wall.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  Json json{{"nodes", regions.size()},     {"triangles", packed32(corners)}, {"regions", wall.region_names},
            {"region", packed32(regions)}, {"place_quantum", grid.place},    {"distance_quantum", grid.distance},
            {"sources", Json::array()}};
  for (const WallSource& source : wall.sources) {
    Json moments = Json::array();
    for (const WallMoment& moment : source.moments) moments.push_back(moment_json(moment, grid, mm));
    json["sources"].push_back({{"name", source.name}, {"contours", source.contours}, {"moments", moments}});
  }
  return json.dump();
}

}  // namespace tether
