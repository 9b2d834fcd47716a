#include "common/config/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"
#include "common/config/named_path.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* way_out = "choose another folder with --output, or give --overwrite";

/// A verb that refused its file leaves no more than a mark.
bool holds_nothing(const fs::path& folder) {
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), [](const fs::directory_entry& entry) {
    return entry.path().filename() == folder_lock_name || entry.path().filename() == made_by;
  });
}

constexpr int levels_looked_at = 3;  ///< results of an explanation's runs stand two below, their checkpoints three
constexpr int entries_looked_at = 200'000;  ///< half a second; of a longer run's frames no more are looked at

/// Runs that several diagnoses share, and a twin's truth: whoever writes there takes the link away, or means it.
bool is_lent_folder(const fs::directory_entry& link) {
  std::error_code none;
  const fs::path in = link.path().parent_path().filename();
  return (in == "runs" || in == "sealed") && (link.is_directory(none) || !link.exists(none));
}

void refuse_pipes_and_links(const fs::path& folder) {
  std::error_code none;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, none), end;
  for (int looked_at = 0; entry != end && looked_at < entries_looked_at; entry.increment(none), ++looked_at) {
    if (entry->is_fifo(none)) throw input_error("{}: is a pipe, not a file of results", entry->path().string());
    if (entry->is_symlink(none) && !is_lent_folder(*entry))
      throw input_error("{}: is a link, not a file of results", entry->path().string());
    if (entry.depth() == levels_looked_at) entry.disable_recursion_pending();
  }
}

bool is_in(const fs::path& path, const fs::path& place) {
  const fs::path from_it = fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(fs::absolute(place)));
  return !from_it.empty() && *from_it.begin() != "..";
}

void check_made_by(const fs::path& folder, const std::string& verb, const FolderOwner& wanted) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw input_error("{}: is not a folder", folder.string());
  check_writable_through(folder);
  if (holds_nothing(folder)) return;
  const FolderOwner owner = owner_in(folder / made_by);
  const bool is_of_verb = owner.line.starts_with(verb + " ");
  if (is_of_verb && owner.is(wanted)) return;
  if (is_of_verb)
    throw input_error("{}: holds what tether {} made of {}; {}", folder.string(), verb,
                      owner.line.substr(verb.size() + 1), way_out);
  throw input_error("{}: holds files that are not what tether {} made; {}", folder.string(), verb, way_out);
}

/// Makes and holds the folder of what a verb makes of these files, and marks it if it is empty; `keeps_inputs` throws
/// if one that is read would be replaced, `keeps_work` if a person's own would.
void hold_marked(const fs::path& folder, bool overwrite, const std::string& verb, const std::vector<fs::path>& files,
                 const std::function<void()>& keeps_inputs, const std::function<void()>& keeps_work) {
  const FolderOwner owner = maker_of(folder, verb, files);
  const auto check = [&] {
    keeps_inputs();
    if (!overwrite) check_made_by(folder, verb, owner);
    keeps_work();
  };
  check();
  hold_output(folder);
  check();  // another may have been there until now
  if (holds_nothing(folder)) write_mark(folder, owner);
}

/// Throws InputError if the folder holds anything but results of this very case file; of any case if `goes_on`: the
/// checkpoint then says whose they are.
void check_owner(const fs::path& folder, const std::string& name, const fs::path& case_file, bool goes_on) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw input_error("{}: is not a folder", folder.string());
  check_writable_through(folder);
  if (!fs::exists(folder / case_as_run)) {
    if (holds_nothing(folder)) return;
    throw input_error("{}: holds files that are not the results of a run; {}", folder.string(), way_out);
  }
  if (goes_on) return;
  const YamlNode marker = read_yaml(folder / case_as_run);
  const YamlNode* owner = marker.find("name");
  const std::optional<fs::path> whose = owner_of(folder);
  const FolderOwner wanted = owner_by(std::string(case_file_key), folder, {case_file});
  std::error_code none;
  if (owner && owner->text == name && whose &&
      (owner_in(folder / case_as_run).is(wanted) || fs::equivalent(*whose, case_file, none)))
    return;
  if (owner && owner->text == name)
    throw input_error("{}: holds the results of another case file of the name '{}'{}; {}", folder.string(), name,
                      whose ? " (" + whose->string() + ")" : "", way_out);
  throw input_error("{}: holds the results of the case '{}'; {}", folder.string(), owner ? owner->text : "?", way_out);
}

}  // namespace

void check_none_is_in(const fs::path& place, const std::set<fs::path>& read) {
  for (const fs::path& one : read)
    if (is_in(one, place))
      throw input_error(
          "{}: is read, and what is written into {} would replace it; choose another folder with --output",
          one.string(), place.string());
}

void check_writable_through(const fs::path& folder) {
  std::error_code none;
  refuse_pipes_and_links(folder);
  const fs::path plots = folder / "plots";
  if (fs::exists(plots, none) && !fs::is_directory(plots, none))
    throw input_error("{}: is not a folder", plots.string());
}

std::optional<fs::path> owner_of(const fs::path& folder) {
  if (!fs::is_regular_file(folder / case_as_run)) return std::nullopt;
  const std::string first = owner_in(folder / case_as_run).line;
  if (!first.starts_with(case_file_key)) return std::nullopt;
  return first.substr(case_file_key.size());
}

fs::path output_of(const CommandLine& command, const CaseFile& file) {
  return command.output.empty() ? fs::path("out") / file.common().name : command.output;
}

void hold_output(const fs::path& folder) {
  check_path(folder / "");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse_folder(folder, "cannot be made", error.value());
  check_writable_through(folder);
  hold_folder(folder);
}

fs::path claim_output(const CommandLine& command, const CaseFile& file) {
  const fs::path folder = output_of(command, file);
  const auto check = [&] {
    check_keeps_inputs(folder, file.path());
    if (!command.overwrite) check_owner(folder, file.common().name, file.path(), command.resume);
  };
  check();
  hold_output(folder);
  check();  // another run may have been there until now
  return folder;
}

void check_keeps_inputs(const fs::path& place, const fs::path& file) {
  std::set<fs::path> read = files_read(file);
  read.merge(folders_read(file));
  check_none_is_in(place, read);
}

fs::path hold_for_made(const CommandLine& command, const MadeOfFile& made) {
  const fs::path folder = command.output.empty() ? fs::path("out") / made.name : command.output;
  const auto keeps_inputs = [&] {
    check_keeps_inputs(folder, command.case_file);
    for (const fs::path& file : made.also) check_keeps_inputs(folder, file);
  };
  hold_marked(folder, command.overwrite, made.verb, {command.case_file}, keeps_inputs,
              [&] { check_keeps_work(folder, made, command.overwrite); });
  if (command.overwrite) note_as_they_are(folder, made.to_go_on_with);
  return folder;
}

void mark_made(const fs::path& folder, const std::string& verb, const fs::path& file) {
  const FolderOwner owner = maker_of(folder, verb, {file}), before = owner_in(folder / made_by);
  if (before.line == owner.line && before.from_here == owner.from_here) return;
  const bool is_moved = before.line.starts_with(verb + " ") && before.is(owner);
  write_mark(folder, owner, is_moved ? notes_in(folder) : std::vector<NotedFile>{});
}

fs::path claim_for_made(const CommandLine& command, const MadeOfFile& made) {
  const fs::path folder = hold_for_made(command, made);
  mark_made(folder, made.verb, command.case_file);
  return folder;
}

fs::path claim_for_made(const fs::path& folder, bool overwrite, const std::string& verb,
                        const std::vector<fs::path>& files) {
  std::set<fs::path> read(files.begin(), files.end());
  for (const fs::path& file : files) read.merge(files_named_in(file));
  hold_marked(
      folder, overwrite, verb, files, [&] { check_none_is_in(folder, read); }, [] {});
  write_mark(folder, maker_of(folder, verb, files));
  return folder;
}

void mark_output(const fs::path& folder, const fs::path& case_file) {
  const FolderOwner owner = owner_by(std::string(case_file_key), folder, {case_file});
  write_whole(
      folder / case_as_run,
      owner.line + "\n" + owner.from_here +
          "\n# A copy of it as it was when the run started, with what it builds on; paths are relative to it.\n" +
          case_text(case_file));
}

fs::path claim_and_mark_output(const CommandLine& command, const CaseFile& file) {
  const fs::path folder = claim_output(command, file);
  mark_output(folder, file.path());
  return folder;
}

}  // namespace tether
