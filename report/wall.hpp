#pragma once

#include <filesystem>

#include "diagnosis/results/compared_wall.hpp"

namespace tether {

/// The lumen of one run at one moment of the measurements.
struct WallState {
  Points positions;    ///< of its nodes [length]
  VectorXd distances;  ///< to the data at each node, positive where these lie outside; NaN: not measured [length]
};

struct WallMoment {
  double time = 0;  ///< in the run [time]
  bool held_out = false;
  std::vector<Points> data;       ///< the measured contours; of surfaces some cuts across the vessel
  std::vector<WallState> states;  ///< one a run
};

/// One source of measurements.
struct WallSource {
  std::string name;
  bool contours = false;
  std::vector<WallMoment> moments;  ///< that all runs reach
};

/// The moving lumen of some runs on the same mesh, and how far it is from the measurements.
struct Wall {
  std::vector<int> triangles;  ///< nodes of each, one after the other
  std::vector<std::string> region_names;
  std::vector<int> region;  ///< of each node; -1: none
  double millimetres = 1;   ///< in the unit of length
  std::vector<WallSource> sources;
};

/// From wall.json in the folders of compared runs of one case. Throws InputError if one has none, or another mesh or
/// other measurements than the first.
Wall wall_of(const std::vector<std::filesystem::path>& runs);

/// For the page: lengths in mm, packed in 16 bits (docs/report.md).
std::string json_of(const Wall& wall);

}  // namespace tether
