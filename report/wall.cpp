#include "report/wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/base/units.hpp"
#include "common/io/record_file.hpp"
#include "report/packed.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const WallMomentTold* same_moment(const WallSourceTold& source, const WallMomentTold& moment) {
  const auto found = std::find_if(source.moments.begin(), source.moments.end(), [&](const WallMomentTold& other) {
    return other.held_out == moment.held_out && std::abs(other.time - moment.time) < 1e-9;
  });
  return found == source.moments.end() ? nullptr : &*found;
}

Points points_of(const PackedFloats& packed) {
  const MatrixXd numbers = unpacked(packed);
  if (numbers.rows() != 3 || !numbers.allFinite())
    throw input_error("{} x {} numbers are no points", numbers.rows(), numbers.cols());
  return numbers;
}

/// Of so many nodes.
WallState state_of(const WallMomentTold& moment, std::size_t nodes) {
  WallState state{points_of(moment.positions), unpacked(moment.distances).reshaped()};
  for (const Eigen::Index count : {state.positions.cols(), state.distances.size()})
    if (static_cast<std::size_t>(count) != nodes)
      throw input_error("positions and distances of {} and {} nodes, where the wall has {}", state.positions.cols(),
                        state.distances.size(), nodes);
  return state;
}

/// A moment of the first run in all that reach it.
WallMoment moment_in(const std::vector<ComparedWall>& runs, std::size_t source, const WallMomentTold& moment) {
  WallMoment result{moment.time, moment.held_out, {}, {}};
  for (const PackedFloats& line : moment.lines) result.data.push_back(points_of(line));
  for (const ComparedWall& run : runs)
    if (const WallMomentTold* there = same_moment(run.sources[source], moment))
      result.states.push_back(state_of(*there, runs.front().region.size()));
  return result;
}

void check_numbers(const ComparedWall& wall, const fs::path& folder) {
  const auto are_below = [](const std::vector<int>& numbers, int least, std::size_t end) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [&](int number) { return number >= least && number < static_cast<std::int64_t>(end); });
  };
  if (wall.triangles.size() % 3 != 0 || !are_below(wall.triangles, 0, wall.region.size()))
    throw input_error("{}: triangles of nodes that it does not have", (folder / "wall.json").string());
  if (!are_below(wall.region, -1, wall.regions.size()))
    throw input_error("{}: nodes in regions that it does not have", (folder / "wall.json").string());
}

void check_same(const ComparedWall& first, const ComparedWall& other, const fs::path& folder) {
  if (other.triangles != first.triangles) throw input_error("{}: is of another mesh", folder.string());
  const auto names = [](const ComparedWall& wall) {
    std::vector<std::string> all;
    for (const WallSourceTold& source : wall.sources) all.push_back(source.name);
    return all;
  };
  if (names(other) != names(first)) throw input_error("{}: has other measurements", folder.string());
}

/// How lengths become 16-bit integers: in mm from the middle of everything drawn.
struct Grid {
  Vec3 centre;             ///< [mm]
  double place, distance;  /// quanta of both [mm]
};

Grid grid_of(const Wall& wall, double mm) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
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

Wall wall_of(const std::vector<fs::path>& folders) {
  std::vector<ComparedWall> runs;
  for (const fs::path& folder : folders) {
    runs.push_back(read_record<ComparedWall>(folder / "wall.json"));
    check_numbers(runs.back(), folder);
    check_same(runs.front(), runs.back(), folder);
  }
  const ComparedWall& first = runs.front();
  Wall wall{first.triangles, first.regions, first.region, UnitSystem::named(first.units).to_mm(1), {}};
  for (std::size_t s = 0; s < first.sources.size(); ++s) {
    WallSource& source = wall.sources.emplace_back(WallSource{first.sources[s].name, first.sources[s].contours, {}});
    for (const WallMomentTold& moment : first.sources[s].moments)
      if (WallMoment found = moment_in(runs, s, moment); found.states.size() == runs.size())
        source.moments.push_back(std::move(found));
  }
  return wall;
}

std::string json_of(const Wall& wall) {
  const double mm = wall.millimetres;
  const Grid grid = grid_of(wall, mm);
  const std::vector<std::int32_t> corners(wall.triangles.begin(), wall.triangles.end()),
      regions(wall.region.begin(), wall.region.end());
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
