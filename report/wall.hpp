#pragma once

#include <filesystem>

#include "common/base/units.hpp"
#include "diagnosis/slices.hpp"

namespace tether {

/// The lumen of one run at one moment of the measurements.
struct WallState {
  Points positions;    ///< of its nodes [length]
  VectorXd distances;  ///< to the data at each node, positive where these lie outside; NaN: not measured [length]
  double root_mean_square{};  ///< over all samples (D.1), as comparison.json has it [length]
};

struct WallMoment {
  double time = 0;  ///< in the run [time]
  bool held_out = false;
  Lines data;                     ///< the measured contours; of surfaces some cuts across the vessel
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
  std::vector<Triangle> triangles;
  std::vector<std::string> region_names;
  std::vector<int> region;  ///< of each node; -1: none
  UnitSystem units = UnitSystem::cgs();
  std::vector<WallSource> sources;
};

/// From the case, which names mesh and measurements, and the folders of finished runs of it. Throws InputError.
Wall wall_of(const std::filesystem::path& case_file, const std::vector<std::filesystem::path>& runs);

/// For the page: lengths in mm, packed in 16 bits (docs/report.md).
std::string json_of(const Wall& wall);

}  // namespace tether
