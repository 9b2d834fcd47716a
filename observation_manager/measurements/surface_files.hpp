#pragma once

#include <filesystem>
#include <vector>

#include "common/base/units.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "observation_manager/measurements/surfaces.hpp"

namespace tether {

/// A file of a series and its time; NaN: it holds always.
struct TimedFile {
  std::filesystem::path file;
  double time = 0;
  std::string where;  ///< what stated the time, for messages
};

/// The files of a series, in the case's unit of time, shifted. Throws InputError: a file that does not exist, a pattern
/// that no file matches, times that do not ascend or lie beyond the period.
std::vector<TimedFile> files_of(const SurfacesCase& given, const UnitSystem& units);

/// All triangles of a surface file, coordinates times `scale`. Throws InputError if it cannot be read.
TriangleSurface read_surface(const std::filesystem::path& file, double scale);

/// Whether a name matches a pattern with * (any characters) and ? (one).
bool matches(std::string_view name, std::string_view pattern);

/// "frame_2" before "frame_10".
bool in_order_of_numbers(const std::string& a, const std::string& b);

}  // namespace tether
