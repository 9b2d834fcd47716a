#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Closed contours from a CSV file with the columns section, point, x, y, z: rows of one section stand together,
/// sections and points in the order of the file; one column a point, in the file's unit of length. Throws InputError
/// "file:line: ...": a section in two places, fewer than 8 points.
std::vector<Points> read_contours(const std::filesystem::path& file);

}  // namespace tether
