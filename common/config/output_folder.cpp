#include "common/config/output_folder.hpp"

#include <algorithm>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/name.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/config/case_tree.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view case_file_key = "# case_file: ";  ///< first line of a mark
constexpr const char* way_out = "choose another folder with --output, or give --overwrite";

bool is_empty_but_for_lock(const fs::path& folder) {
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const fs::directory_entry& entry) { return entry.path().filename() == folder_lock_name; });
}

void refuse_pipes_and_links(const fs::path& folder) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.is_fifo(none)) throw input_error("{}: is a pipe, not a file of results", entry.path().string());
    if (entry.is_symlink(none)) throw input_error("{}: is a link, not a file of results", entry.path().string());
  }
}

/// Throws InputError if the folder holds anything but results of this very case file; of any case if `goes_on`: the
/// checkpoint then says whose they are.
void check_owner(const fs::path& folder, const std::string& name, const fs::path& case_file, bool goes_on) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw input_error("{}: is not a folder", folder.string());
  check_writable_through(folder);
  if (!fs::exists(folder / case_as_run)) {
    if (is_empty_but_for_lock(folder)) return;
    throw input_error("{}: holds files that are not the results of a run; {}", folder.string(), way_out);
  }
  if (goes_on) return;
  const YamlNode marker = read_yaml(folder / case_as_run);
  const YamlNode* owner = marker.find("name");
  const std::optional<fs::path> whose = owner_of(folder);
  if (owner && owner->text == name && whose == fs::absolute(case_file).lexically_normal()) return;
  if (owner && owner->text == name)
    throw input_error("{}: holds the results of another case file of the name '{}'{}; {}", folder.string(), name,
                      whose ? " (" + whose->string() + ")" : "", way_out);
  throw input_error("{}: holds the results of the case '{}'; {}", folder.string(), owner ? owner->text : "?", way_out);
}

}  // namespace

void check_writable_through(const fs::path& folder) {
  std::error_code none;
  refuse_pipes_and_links(folder);
  const fs::path plots = folder / "plots";
  if (fs::exists(plots, none) && !fs::is_directory(plots, none))
    throw input_error("{}: is not a folder", plots.string());
  refuse_pipes_and_links(plots);
}

std::optional<fs::path> owner_of(const fs::path& folder) {
  if (!fs::is_regular_file(folder / case_as_run)) return std::nullopt;
  std::ifstream mark(folder / case_as_run);
  std::string first;
  std::getline(mark, first);
  if (!first.starts_with(case_file_key)) return std::nullopt;
  return first.substr(case_file_key.size());
}

fs::path output_of(const CommandLine& command, const CaseFile& file) {
  return command.output.empty() ? fs::path("out") / file.common().name : command.output;
}

void hold_output(const fs::path& folder) {
  if (!is_utf8(fs::absolute(folder).string()))
    throw input_error("{}: its path is not UTF-8, as results must be, which name it", folder.string());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_folder(folder, "cannot be made", error.value());
  check_writable_through(folder);
  hold_folder(folder);
}

fs::path claim_output(const CommandLine& command, const CaseFile& file) {
  const fs::path folder = output_of(command, file);
  const auto check = [&] {
    if (!command.overwrite) check_owner(folder, file.common().name, file.path(), command.resume);
  };
  check();
  hold_output(folder);
  check();  // another run may have been there until now
  return folder;
}

void mark_output(const fs::path& folder, const fs::path& case_file) {
  write_whole(
      folder / case_as_run,
      std::string(case_file_key) + fs::absolute(case_file).lexically_normal().string() +
          "\n# A copy of it as it was when the run started, with what it builds on; paths are relative to it.\n" +
          case_text(case_file));
}

fs::path claim_and_mark_output(const CommandLine& command, const CaseFile& file) {
  const fs::path folder = claim_output(command, file);
  mark_output(folder, file.path());
  return folder;
}

}  // namespace tether
