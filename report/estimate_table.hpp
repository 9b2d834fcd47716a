#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tether {

/// estimate.csv as JSON: {"time": [...], "parameters": {NAME: {"value", "lower", "upper"}}}, thinned out to at most
/// `most` moments, the last one kept. `names`: of the parameters. Throws InputError.
std::string estimate_over_time(const std::filesystem::path& csv, const std::vector<std::string>& names,
                               std::size_t most = 300);

}  // namespace tether
