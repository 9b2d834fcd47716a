#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// What stands in a folder about whose it is: in `case_as_run.yaml` of a run's results, in `made_by.txt` of what a verb
/// made.
namespace tether {

/// The file in a folder of what a verb made that says so: the verb, the file it was made of, also as seen from the
/// folder, and what files for a person to go on with held. It is not hidden: who copies the folder is to have it too.
inline constexpr const char* made_by = "made_by.txt";

inline constexpr std::string_view case_file_key = "# case_file: ";  ///< before the case in the first line of a run's

/// Whose a folder is, in two lines: by the absolute paths of files, and by those from the folder, which are right still
/// when both are moved or copied.
struct FolderOwner {
  std::string line, from_here;

  bool is(const FolderOwner& other) const {
    return line == other.line || (!from_here.empty() && from_here == other.from_here);
  }
};

/// That of a mark; empty lines if there is none.
FolderOwner owner_in(const std::filesystem::path& mark);
/// `before`: what the first line begins with. "build-model /home/ada/study.yaml", "measure-noise /home/ada/one.stl and
/// /home/ada/two.stl". Throws InputError for a path that is no line of text (check_path).
FolderOwner owner_by(const std::string& before, const std::filesystem::path& folder,
                     const std::vector<std::filesystem::path>& files);
/// The same of what a verb makes.
FolderOwner maker_of(const std::filesystem::path& folder, const std::string& verb,
                     const std::vector<std::filesystem::path>& files);

/// A line of a mark behind its first: a file that was made for a person to go on with, and what it held then; after a
/// kill also what it was about to hold.
struct NotedFile {
  std::string content;
  std::filesystem::path file;

  std::string line() const { return content + " " + file.string(); }
  bool operator==(const NotedFile&) const = default;
};

/// Those of a folder's `made_by.txt`; none if it has none.
std::vector<NotedFile> notes_in(const std::filesystem::path& folder);
/// Writes `made_by.txt`.
void write_mark(const std::filesystem::path& folder, const FolderOwner& owner,
                const std::vector<NotedFile>& notes = {});

}  // namespace tether
