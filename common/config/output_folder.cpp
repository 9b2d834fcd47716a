#include "common/config/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "common/base/checked_file.hpp"
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

constexpr std::string_view case_file_key = "# case_file: ";  ///< first line of a mark
constexpr std::string_view from_here_key = "# from here: ";  ///< second line: the same file as seen from the folder
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

/// Whose a folder is, in two lines: by the absolute paths of files, and by those from the folder, which are right still
/// when both are moved or copied.
struct Owner {
  std::string line, from_here;

  bool is(const Owner& other) const {
    return line == other.line || (!from_here.empty() && from_here == other.from_here);
  }
};

/// As long as paths may be.
Owner owner_in(const fs::path& mark) {
  std::string begin(16384, '\0');
  std::ifstream file(mark, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t end = std::min(begin.find('\n'), begin.size());
  Owner owner{begin.substr(0, end), ""};
  if (const std::string rest = begin.substr(std::min(end + 1, begin.size())); rest.starts_with(from_here_key))
    owner.from_here = rest.substr(0, rest.find('\n'));
  return owner;
}

/// `before`: what the first line begins with. "build-model /home/ada/study.yaml", "measure-noise /home/ada/one.stl and
/// /home/ada/two.stl".
Owner owner_by(const std::string& before, const fs::path& folder, const std::vector<fs::path>& files) {
  Owner owner{before, std::string(from_here_key)};
  const fs::path here = fs::weakly_canonical(fs::absolute(folder));
  const char* between = "";
  for (const fs::path& file : files) {
    check_path(file);
    const fs::path place = place_of(file);
    owner.line += between + place.string();
    owner.from_here += between + place.lexically_relative(here).string();
    between = " and ";
  }
  return owner;
}

Owner maker(const fs::path& folder, const std::string& verb, const std::vector<fs::path>& files) {
  return owner_by(verb + " ", folder, files);
}

/// A line of a mark behind its first: a file that was made for a person to go on with, and what it held then; after a
/// kill also what it was about to hold.
struct Note {
  std::string content;
  fs::path file;

  std::string line() const { return content + " " + file.string(); }
  bool operator==(const Note&) const = default;
};

void check_made_by(const fs::path& folder, const std::string& verb, const Owner& wanted) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw input_error("{}: is not a folder", folder.string());
  check_writable_through(folder);
  if (holds_nothing(folder)) return;
  const Owner owner = owner_in(folder / made_by);
  const bool is_of_verb = owner.line.starts_with(verb + " ");
  if (is_of_verb && owner.is(wanted)) return;
  if (is_of_verb)
    throw input_error("{}: holds what tether {} made of {}; {}", folder.string(), verb,
                      owner.line.substr(verb.size() + 1), way_out);
  throw input_error("{}: holds files that are not what tether {} made; {}", folder.string(), verb, way_out);
}

void write_mark(const fs::path& folder, const Owner& owner, const std::vector<Note>& notes = {}) {
  std::string mark = owner.line + "\n";
  if (!owner.from_here.empty()) mark += owner.from_here + "\n";
  for (const Note& note : notes) mark += note.line() + "\n";
  write_whole(folder / made_by, mark);
}

/// Makes and holds the folder of what a verb makes of these files, and marks it if it is empty; `keeps_inputs` throws
/// if one that is read would be replaced, `keeps_work` if a person's own would.
void hold_marked(const fs::path& folder, bool overwrite, const std::string& verb, const std::vector<fs::path>& files,
                 const std::function<void()>& keeps_inputs, const std::function<void()>& keeps_work) {
  const Owner owner = maker(folder, verb, files);
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

constexpr const char* mark_of_results = "results";  ///< first line where only files of a case's results are noted

/// Of the file alone, not of those that it names: they are put in place one by one.
Note note_of(const fs::path& file, const fs::path& written) {
  std::ifstream from(written, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(from), {});
  return {fmt::format("{:016x}", hash_bytes(bytes.data(), bytes.size())), file};
}

std::vector<Note> notes_in(const fs::path& folder) {
  std::vector<Note> notes;
  std::ifstream mark(folder / made_by);
  std::string line;
  for (std::getline(mark, line); std::getline(mark, line);)
    if (const auto end = line.find(' '); end != std::string::npos && !line.starts_with(from_here_key))
      notes.push_back({line.substr(0, end), line.substr(end + 1)});
  return notes;
}

bool has(const std::vector<Note>& notes, const Note& note) {
  return std::find(notes.begin(), notes.end(), note) != notes.end();
}

bool is_noted(const std::vector<Note>& notes, const fs::path& file) {
  return std::any_of(notes.begin(), notes.end(), [&](const Note& note) { return note.file == file; });
}

/// Of these files those that are there, but not as it was noted.
std::vector<fs::path> changed_of(const fs::path& folder, const std::vector<fs::path>& to_go_on_with) {
  const std::vector<Note> notes = notes_in(folder);
  std::vector<fs::path> changed;
  for (const fs::path& file : to_go_on_with)
    if (is_noted(notes, file) && fs::exists(folder / file) && !has(notes, note_of(file, folder / file)))
      changed.push_back(file);
  return changed;
}

void write_notes(const fs::path& folder, const std::vector<Note>& notes) {
  Owner owner = owner_in(folder / made_by);
  if (owner.line.empty()) owner.line = mark_of_results;
  write_mark(folder, owner, notes);
}

bool is_as_noted(const fs::path& folder, const std::string& verb, const fs::path& file) {
  return owner_in(folder / made_by).line.starts_with(verb + " ") && has(notes_in(folder), note_of(file, folder / file));
}

[[noreturn]] void refuse_changed(const fs::path& file, const std::string& verb) {
  throw input_error("{}: is not as tether {} made it, and would be replaced; keep it elsewhere, or give --overwrite",
                    file.string(), verb);
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
  const Owner wanted = owner_by(std::string(case_file_key), folder, {case_file});
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
  const Owner owner = maker(folder, verb, {file}), before = owner_in(folder / made_by);
  if (before.line == owner.line && before.from_here == owner.from_here) return;
  const bool is_moved = before.line.starts_with(verb + " ") && before.is(owner);
  write_mark(folder, owner, is_moved ? notes_in(folder) : std::vector<Note>{});
}

/// A case has a common name: one of the person's own is not replaced, nor what the person made of one.
void check_keeps_work(const fs::path& folder, const MadeOfFile& made, bool overwrite) {
  for (const fs::path& file : made.to_go_on_with) {
    if (!fs::exists(folder / file) || is_as_noted(folder, made.verb, file)) continue;
    if (!fs::exists(folder / made.before_these))
      throw input_error("{}: is not what tether {} made, and would be replaced; choose another folder with --output",
                        (folder / file).string(), made.verb);
    if (!overwrite) refuse_changed(folder / file, made.verb);
  }
}

void note_as_they_are(const fs::path& folder, const std::vector<fs::path>& to_go_on_with) {
  if (!fs::exists(folder / made_by)) return;
  std::vector<Note> notes = notes_in(folder);
  const std::size_t before = notes.size();
  for (const fs::path& file : to_go_on_with)
    if (fs::exists(folder / file))
      if (const Note note = note_of(file, folder / file); !has(notes, note)) notes.push_back(note);
  if (notes.size() > before) write_notes(folder, notes);
}

void note_coming(const fs::path& folder, const std::vector<ComingFile>& coming) {
  std::vector<fs::path> names;
  for (const ComingFile& one : coming) names.push_back(one.name);
  check_not_changed_meanwhile(folder, names);
  const std::vector<Note> before = notes_in(folder);
  std::vector<Note> notes;
  for (const Note& note : before) {
    const bool is_coming =
        std::any_of(coming.begin(), coming.end(), [&](const ComingFile& one) { return one.name == note.file; });
    const bool stays = fs::exists(folder / note.file) && (!is_coming || note == note_of(note.file, folder / note.file));
    if (stays) notes.push_back(note);
  }
  for (const auto& [name, written] : coming)
    if (const Note note = note_of(name, written); !has(notes, note)) notes.push_back(note);
  if (notes != before) write_notes(folder, notes);
}

void check_not_changed_meanwhile(const fs::path& folder, const std::vector<fs::path>& to_go_on_with) {
  for (const fs::path& file : changed_of(folder, to_go_on_with))
    throw run_error(
        "{}: was changed while its next version was made, and is kept; keep it elsewhere, and give the same command",
        (folder / file).string());
}

bool make_to_go_on_with(const fs::path& folder, const fs::path& name,
                        const std::function<void(const fs::path&)>& write) {
  const fs::path beside = folder / (".new_" + name.string());
  std::error_code none;
  fs::remove(beside, none);
  try {
    write(beside);
    if (!fs::exists(beside)) return false;
    if (!changed_of(folder, {name}).empty()) {
      const fs::path other = (folder / name).replace_extension(".new" + name.extension().string());
      put_in_place(beside, other);
      throw run_error("{}: was changed while its next version was made, and is kept; the new one is {}",
                      (folder / name).string(), other.filename().string());
    }
    note_coming(folder, {{name, beside}});
    put_in_place(beside, folder / name);
    return true;
  } catch (...) {
    fs::remove(beside, none);
    throw;
  }
}

void check_unchanged(const fs::path& folder, const std::string& verb, const std::vector<fs::path>& to_go_on_with) {
  for (const fs::path& file : changed_of(folder, to_go_on_with)) refuse_changed(folder / file, verb);
}

void check_replaceable(const fs::path& folder, const std::string& verb, const std::vector<fs::path>& to_go_on_with,
                       bool overwrite) {
  if (overwrite) {
    note_as_they_are(folder, to_go_on_with);
    return;
  }
  check_unchanged(folder, verb, to_go_on_with);
  const std::vector<Note> notes = notes_in(folder);
  for (const fs::path& file : to_go_on_with)
    if (fs::exists(folder / file) && !is_noted(notes, file))
      throw input_error(
          "{}: nothing says that tether {} made it ({} is missing or of an earlier version), and it "
          "would be replaced; keep it elsewhere, or give --overwrite",
          (folder / file).string(), verb, made_by);
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
  write_mark(folder, maker(folder, verb, files));
  return folder;
}

void mark_output(const fs::path& folder, const fs::path& case_file) {
  const Owner owner = owner_by(std::string(case_file_key), folder, {case_file});
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
