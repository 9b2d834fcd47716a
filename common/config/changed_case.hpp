#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// Why results cannot be gone on with, for messages: what the case says otherwise than it did when they were begun
/// (case_as_run.yaml in their folder), "time.step: 2e-3 now, 1e-3 before; solid.viscosity: 500 now, none before";
/// where it says the same, the files that it names and that were written since. Empty if neither tells anything.
std::string told_changes(const std::filesystem::path& results, const std::filesystem::path& case_file);

}  // namespace tether
