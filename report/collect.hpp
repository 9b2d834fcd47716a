#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// All that a report shows of a folder of results, as one JSON document (docs/report.md): of `tether explain`, or what
/// exists of comparison.json, diagnosis.json and estimate.json, or where none of these is, a run's summary.json. What
/// cannot be shown is said in its `notes`. Throws InputError if the folder holds none of these, or one that is broken.
std::string collected(const std::filesystem::path& folder);

}  // namespace tether
