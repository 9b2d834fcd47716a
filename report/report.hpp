#pragma once

#include <filesystem>

namespace tether {

/// Writes FOLDER/report.html, one file that needs no other (docs/report.md), and returns its path. Throws InputError if
/// there is nothing to report, RunError if it cannot be written.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace tether
