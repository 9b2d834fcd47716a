#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fsi_master/results/run_summary.hpp"

namespace tether {

/// For a person: duration, cost, pressures, displacement, coupling.
std::string text_of(const RunSummary& summary);

/// What the output folder holds and how to look at it.
std::string where_to_look(const std::filesystem::path& output, const std::vector<std::string>& plots);

}  // namespace tether
