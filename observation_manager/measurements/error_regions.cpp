#include "observation_manager/measurements/error_regions.hpp"

#include <algorithm>
#include <numeric>

#include "common/base/error.hpp"

namespace tether {

ErrorRegions::ErrorRegions(std::vector<std::string> regions_of_wall)
    : names(std::move(regions_of_wall)), parts(names.size()) {
  std::iota(parts.begin(), parts.end(), 0);
}

int ErrorRegions::of(int region_of_wall) const {
  return region_of_wall < 0 ? -1 : parts.at(static_cast<std::size_t>(region_of_wall));
}

ErrorRegions error_regions(const Named<ErrorRegionCase>& given, const std::vector<std::string>& regions_of_wall,
                           const CaseFile& file) {
  if (given.empty()) return regions_of_wall;
  ErrorRegions regions;
  regions.parts.assign(regions_of_wall.size(), -1);
  for (const auto& [name, part] : given) {
    const std::string where = file.where("observations.regions." + name + ".of");
    for (const std::string& region : part.of) {
      const auto found = std::find(regions_of_wall.begin(), regions_of_wall.end(), region);
      if (found == regions_of_wall.end())
        throw input_error("{}: the wall has no region '{}'; it has {}", where, region,
                          fmt::join(regions_of_wall, ", "));
      int& owner = regions.parts[static_cast<std::size_t>(found - regions_of_wall.begin())];
      if (owner >= 0)
        throw input_error("{}: {} belongs to {} already", where, region, given[static_cast<std::size_t>(owner)].first);
      owner = static_cast<int>(regions.names.size());
    }
    regions.names.push_back(name);
  }
  return regions;
}

}  // namespace tether
