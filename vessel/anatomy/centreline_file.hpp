#pragma once

#include <filesystem>

#include "common/base/units.hpp"
#include "vessel/centreline/tree.hpp"

namespace tether {

/// Reads a table with the columns branch, x, y, z, radius, and, except for trees of one generation, parent: the name of
/// the branch that it leaves; empty for the trunk. Without it all branches leave the first. Lengths come in the case's
/// units. Throws InputError with file and line.
CentrelineTree read_centreline(const std::filesystem::path& file, const UnitSystem& units);

/// Writes the same, in `unit` of length: "cm". Throws RunError.
void write_centreline(const std::filesystem::path& file, const CentrelineTree& tree, const std::string& unit);

}  // namespace tether
