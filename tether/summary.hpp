#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tether {

/// What OUTPUT/summary.json says, for a person: duration, cost, pressures, displacement, coupling. Throws InputError
/// if it is no summary.
std::string summary_text(const std::filesystem::path& output);

/// What the output folder holds and how to look at it.
std::string where_to_look(const std::filesystem::path& output, const std::vector<std::string>& plots);

}  // namespace tether
