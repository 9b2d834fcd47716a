#pragma once

#include "common/config/case_file.hpp"
#include "common/config/command_line.hpp"

namespace tether {

/// The file in an output folder that says whose results it holds: a copy of the case,
/// merged with what it builds on.
inline constexpr const char* case_as_run = "case_as_run.yaml";

/// Where a run's results are, or will be: --output, or out/NAME.
std::filesystem::path output_of(const CommandLine& command, const CaseFile& file);

/// The folder for a run's results: --output, or out/NAME. It is made if it does not exist, and marked as this case's.
/// Throws InputError if it holds another case's results, or files that are no results, unless --overwrite.
std::filesystem::path claim_output(const CommandLine& command, const CaseFile& file);

}  // namespace tether
