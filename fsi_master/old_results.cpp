#include "fsi_master/old_results.hpp"

#include <regex>
#include <vector>

#include "fsi_master/checkpoint.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Files, and links to files, right in the folder.
template <class IsOld>
void remove_files(const fs::path& folder, const IsOld& is_old) {
  std::error_code none;
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file(none) && is_old(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& file : old) fs::remove(file);
}

bool is_picture_of_comparison(const std::string& name) {
  const auto begins = [&name](const char* kind) { return name.starts_with(kind); };
  return begins("comparison_") || begins("trace_") || begins("velocity_") || begins("contours_") || begins("wall_");
}

/// solid_000020.vtu, or one that was being written. Of a link to a folder of frames the link alone goes.
void remove_frames(const fs::path& folder) {
  static const std::regex frame("[a-z_]+_[0-9]{6,}\\.vtu.*");
  if (fs::is_symlink(folder)) fs::remove(folder);
  remove_files(folder, [](const std::string& name) { return std::regex_match(name, frame); });
  if (fs::is_directory(folder) && fs::is_empty(folder)) fs::remove(folder);
}

}  // namespace

void remove_what_was_made_of_runs(const fs::path& output) {
  for (const char* name : {"comparison.json", "comparison.csv", "comparison_blood.csv", "wall.json", "report.html"})
    fs::remove(output / name);
  remove_files(output / "plots", is_picture_of_comparison);
}

void remove_old_results(const fs::path& output) {
  for (const char* name :
       {"summary.json", "timeseries.csv", "lumen.motion", "blood.velocity", "fluid.pvd", "solid.pvd", "rest.json"})
    fs::remove(output / name);
  remove_frames(output / "vtk");
  remove_checkpoints(output);
  remove_what_was_made_of_runs(output);
}

}  // namespace tether
