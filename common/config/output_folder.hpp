#pragma once

#include "common/config/case_file.hpp"
#include "common/config/command_line.hpp"

namespace tether {

/// The file in an output folder that says whose results it holds: a copy of the case,
/// merged with what it builds on.
inline constexpr const char* case_as_run = "case_as_run.yaml";

/// The case file whose results a folder holds; nothing if it does not say. It need not exist any more.
std::optional<std::filesystem::path> owner_of(const std::filesystem::path& folder);

/// Throws InputError if a file of results, or of its plots, is a link, through which files elsewhere would be written
/// and removed, or a pipe, which would be waited for without end.
void check_writable_through(const std::filesystem::path& folder);

/// Where a run's results are, or will be: --output, or out/NAME.
std::filesystem::path output_of(const CommandLine& command, const CaseFile& file);

/// Makes the folder if need be, and holds it (hold_folder). Throws InputError if that cannot be.
void hold_output(const std::filesystem::path& folder);

/// The folder for a run's results: --output, or out/NAME. It is made if need be, and held. Throws InputError also if
/// there are another case's results in it, or files that are no results, unless --overwrite. With --resume another case
/// file may go on, one that lasts longer: whether it is the same run is for the checkpoint to say.
std::filesystem::path claim_output(const CommandLine& command, const CaseFile& file);

/// Marks a folder as this case's, as the case and its files now are. To be called when no results of an earlier state
/// of the case are left in it.
void mark_output(const std::filesystem::path& folder, const std::filesystem::path& case_file);

/// Both.
std::filesystem::path claim_and_mark_output(const CommandLine& command, const CaseFile& file);

}  // namespace tether
