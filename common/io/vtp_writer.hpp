#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// Polylines, one column a point, as a .vtp file for viewing. Throws RunError if it cannot be written.
void write_vtp(const std::filesystem::path& path, const std::vector<Points>& lines);

/// A triangulated surface as a .vtp file; coordinates to seven digits. Throws RunError if it cannot be written.
void write_vtp(const std::filesystem::path& path, const Points& points, const std::vector<Triangle>& triangles);

/// The same with a label on each triangle, array ModelFaceID.
void write_vtp(const std::filesystem::path& path, const Points& points, const std::vector<Triangle>& triangles,
               const std::vector<int>& labels);

/// Polylines with a value at each point, one after the other. Throws RunError if it cannot be written.
void write_vtp(const std::filesystem::path& path, const std::vector<Points>& lines, const std::string& name,
               const std::vector<double>& values);

}  // namespace tether
