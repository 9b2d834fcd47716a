#include "common/config/files_to_go_on_with.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/base/whole_file.hpp"
#include "common/config/folder_mark.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* mark_of_results = "results";  ///< first line where only files of a case's results are noted

/// Of the file alone, not of those that it names: they are put in place one by one.
NotedFile note_of(const fs::path& file, const fs::path& written) {
  std::ifstream from(written, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(from), {});
  return {fmt::format("{:016x}", hash_bytes(bytes.data(), bytes.size())), file};
}

bool has(const std::vector<NotedFile>& notes, const NotedFile& note) {
  return std::find(notes.begin(), notes.end(), note) != notes.end();
}

bool is_noted(const std::vector<NotedFile>& notes, const fs::path& file) {
  return std::any_of(notes.begin(), notes.end(), [&](const NotedFile& note) { return note.file == file; });
}

/// Of these files those that are there, but not as it was noted.
std::vector<fs::path> changed_of(const fs::path& folder, const std::vector<fs::path>& to_go_on_with) {
  const std::vector<NotedFile> notes = notes_in(folder);
  std::vector<fs::path> changed;
  for (const fs::path& file : to_go_on_with)
    if (is_noted(notes, file) && fs::exists(folder / file) && !has(notes, note_of(file, folder / file)))
      changed.push_back(file);
  return changed;
}

void write_notes(const fs::path& folder, const std::vector<NotedFile>& notes) {
  FolderOwner owner = owner_in(folder / made_by);
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

}  // namespace

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
  std::vector<NotedFile> notes = notes_in(folder);
  const std::size_t before = notes.size();
  for (const fs::path& file : to_go_on_with)
    if (fs::exists(folder / file))
      if (const NotedFile note = note_of(file, folder / file); !has(notes, note)) notes.push_back(note);
  if (notes.size() > before) write_notes(folder, notes);
}

void note_coming(const fs::path& folder, const std::vector<ComingFile>& coming) {
  std::vector<fs::path> names;
  for (const ComingFile& one : coming) names.push_back(one.name);
  check_not_changed_meanwhile(folder, names);
  const std::vector<NotedFile> before = notes_in(folder);
  std::vector<NotedFile> notes;
  for (const NotedFile& note : before) {
    const bool is_coming =
        std::any_of(coming.begin(), coming.end(), [&](const ComingFile& one) { return one.name == note.file; });
    const bool stays = fs::exists(folder / note.file) && (!is_coming || note == note_of(note.file, folder / note.file));
    if (stays) notes.push_back(note);
  }
  for (const auto& [name, written] : coming)
    if (const NotedFile note = note_of(name, written); !has(notes, note)) notes.push_back(note);
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
  const std::vector<NotedFile> notes = notes_in(folder);
  for (const fs::path& file : to_go_on_with)
    if (fs::exists(folder / file) && !is_noted(notes, file))
      throw input_error(
          "{}: nothing says that tether {} made it ({} is missing or of an earlier version), and it "
          "would be replaced; keep it elsewhere, or give --overwrite",
          (folder / file).string(), verb, made_by);
}

}  // namespace tether
