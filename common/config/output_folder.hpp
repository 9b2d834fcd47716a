#pragma once

#include <set>

#include "common/config/case_file.hpp"
#include "common/config/command_line.hpp"
#include "common/config/files_to_go_on_with.hpp"
#include "common/config/folder_mark.hpp"

namespace tether {

/// The file in an output folder that says whose results it holds: a copy of the case,
/// merged with what it builds on.
inline constexpr const char* case_as_run = "case_as_run.yaml";

/// The case file whose results a folder holds; nothing if it does not say. It need not exist any more.
std::optional<std::filesystem::path> owner_of(const std::filesystem::path& folder);

/// Throws InputError if a file of results, or of the folders in it, is a link, through which files elsewhere would be
/// written and removed, or a pipe, which would be waited for without end. Runs that are shared, and a twin's truth, may
/// be links to their folders.
void check_writable_through(const std::filesystem::path& folder);

/// Where a run's results are, or will be: --output, or out/NAME.
std::filesystem::path output_of(const CommandLine& command, const CaseFile& file);

/// Makes the folder if need be, and holds it (hold_folder). Throws InputError if that cannot be.
void hold_output(const std::filesystem::path& folder);

/// The folder for a run's results: --output, or out/NAME. It is made if need be, and held. Throws InputError also if
/// there are another case's results in it, or files that are no results, unless --overwrite; with it, too, if the case
/// reads a file in it (check_keeps_inputs). With --resume another case file may go on, one that lasts longer: whether
/// it is the same run is for the checkpoint to say.
std::filesystem::path claim_output(const CommandLine& command, const CaseFile& file);

/// The folder for it: --output, or out/NAME. It is made if need be, held, and marked. Throws InputError before anything
/// in it is touched, if it holds anything but what the same verb made of the same file, or of that a file to go on with
/// that was changed since, unless --overwrite; with it, too, if a file stands in it that is read (the verb's, those of
/// `also`, or one that they name), or one of the name of a file to go on with, without what the verb makes before.
std::filesystem::path claim_for_made(const CommandLine& command, const MadeOfFile& made);

/// The same, for what may still be refused: a folder that is not empty is as it was, and mark_made is to follow.
std::filesystem::path hold_for_made(const CommandLine& command, const MadeOfFile& made);
void mark_made(const std::filesystem::path& folder, const std::string& verb, const std::filesystem::path& file);

/// The same as claim_for_made for what a verb makes of files none of which is a case, in this order.
std::filesystem::path claim_for_made(const std::filesystem::path& folder, bool overwrite, const std::string& verb,
                                     const std::vector<std::filesystem::path>& files);

/// Throws InputError if one of these files and folders, which are read, is `place` or stands in it: it would be
/// removed.
void check_none_is_in(const std::filesystem::path& place, const std::set<std::filesystem::path>& read);

/// Throws InputError if the file, or a file or folder that it is read from (files_read, folders_read), is `place` or
/// stands in it.
void check_keeps_inputs(const std::filesystem::path& place, const std::filesystem::path& file);

/// Marks a folder as this case's, as the case and its files now are. To be called when no results of an earlier state
/// of the case are left in it.
void mark_output(const std::filesystem::path& folder, const std::filesystem::path& case_file);

/// Both.
std::filesystem::path claim_and_mark_output(const CommandLine& command, const CaseFile& file);

}  // namespace tether
