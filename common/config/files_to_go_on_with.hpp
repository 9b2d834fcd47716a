#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// What a verb makes for a person to go on with - a case, a surface, a twin's data - is the person's once it is
/// changed: the folder notes what it held, and what is not as noted is not replaced.
namespace tether {

/// What a verb that makes no run makes of its file.
struct MadeOfFile {
  std::string verb, name;                                 ///< the folder's, without --output
  std::vector<std::filesystem::path> also = {};           ///< read beside the verb's own file
  std::vector<std::filesystem::path> to_go_on_with = {};  ///< files for the person to change: "case.yaml"
  std::filesystem::path before_these = {};                ///< stands in the folder before they do
};

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

/// To be called before a verb makes these files anew. Throws InputError as check_unchanged, and for one that nothing is
/// noted of: nobody knows whose it is. With `overwrite` neither: they are noted as they are.
void check_replaceable(const std::filesystem::path& folder, const std::string& verb,
                       const std::vector<std::filesystem::path>& to_go_on_with, bool overwrite);

}  // namespace tether
