#pragma once

#include "common/config/case_file.hpp"
#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// The parts of the wall for which distances are told: unions of its regions.
struct ErrorRegions {
  ErrorRegions() = default;
  /// Each region of the wall by itself.
  ErrorRegions(std::vector<std::string> regions_of_wall);

  /// Number of the part that a region of the wall belongs to; -1: none, or no region.
  int of(int region_of_wall) const;

  std::vector<std::string> names;
  std::vector<int> parts;  ///< of each region of the wall
};

/// As a case has them; those of the wall where it has none. Throws InputError for a region that the wall does not have,
/// or one that two parts have.
ErrorRegions error_regions(const Named<ErrorRegionCase>& given, const std::vector<std::string>& regions_of_wall,
                           const CaseFile& file);

}  // namespace tether
