#pragma once

#include <functional>
#include <set>

#include "common/config/case_file.hpp"
#include "common/config/command_line.hpp"

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

/// The file in a folder of what a verb made that says so: the verb, the file it was made of, also as seen from the
/// folder, and what files for a person to go on with held. It is not hidden: who copies the folder is to have it too.
inline constexpr const char* made_by = "made_by.txt";

/// What a verb that makes no run makes of its file.
struct MadeOfFile {
  std::string verb, name;                                 ///< the folder's, without --output
  std::vector<std::filesystem::path> also = {};           ///< read beside the verb's own file
  std::vector<std::filesystem::path> to_go_on_with = {};  ///< files for the person to change: "case.yaml"
  std::filesystem::path before_these = {};                ///< stands in the folder before they do
};

/// The folder for it: --output, or out/NAME. It is made if need be, held, and marked. Throws InputError before anything
/// in it is touched, if it holds anything but what the same verb made of the same file, or of that a file to go on with
/// that was changed since, unless --overwrite; with it, too, if a file stands in it that is read (the verb's, those of
/// `also`, or one that they name), or one of the name of a file to go on with, without what the verb makes before.
std::filesystem::path claim_for_made(const CommandLine& command, const MadeOfFile& made);

/// The same, for what may still be refused: a folder that is not empty is as it was, and mark_made is to follow.
std::filesystem::path hold_for_made(const CommandLine& command, const MadeOfFile& made);
void mark_made(const std::filesystem::path& folder, const std::string& verb, const std::filesystem::path& file);

/// Throws InputError as claim_for_made does for files to go on with: for those that are known only when it is held.
void check_keeps_work(const std::filesystem::path& folder, const MadeOfFile& made, bool overwrite);

/// With --overwrite these files may be replaced: if the folder is marked, what they hold now is noted, too.
void note_as_they_are(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& to_go_on_with);

/// A file to go on with, and where what it will hold is written.
struct ComingFile {
  std::filesystem::path name, written;
};

/// Notes what these files will hold, beside what they hold now if a verb made that, before the new ones take their
/// places: whenever the process ends, the same command finds what it knows. Of other files the notes stay. Throws as
/// check_not_changed_meanwhile, before anything is noted.
void note_coming(const std::filesystem::path& folder, const std::vector<ComingFile>& coming);

/// Throws RunError if one of these files is not as it was noted: the person changed it while its next version was made.
void check_not_changed_meanwhile(const std::filesystem::path& folder,
                                 const std::vector<std::filesystem::path>& to_go_on_with);

/// Makes a file to go on with in a folder of results: beside its place by `write`, noted, then put there. False if
/// `write` wrote none: what is there stays. Throws RunError if the person changed it meanwhile: the new one is then
/// left beside it, NAME.new.yaml.
bool make_to_go_on_with(const std::filesystem::path& folder, const std::filesystem::path& name,
                        const std::function<void(const std::filesystem::path&)>& write);

/// Throws InputError if one of these files of a folder of results was made by make_to_go_on_with and changed since. One
/// that nothing is noted of, of an earlier version, is taken for unchanged.
void check_unchanged(const std::filesystem::path& folder, const std::string& verb,
                     const std::vector<std::filesystem::path>& to_go_on_with);

/// Whether these files may be replaced by what the verb is about to make. Throws InputError as check_unchanged, and for
/// one that nothing is noted of: nobody knows whose it is. If they are to be, `overwrite`, they are noted as they are.
void check_replaceable(const std::filesystem::path& folder, const std::string& verb,
                       const std::vector<std::filesystem::path>& to_go_on_with, bool overwrite);

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
