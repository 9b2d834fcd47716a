#include "common/config/folder_mark.hpp"

#include <algorithm>
#include <fstream>

#include "common/base/whole_file.hpp"
#include "common/config/named_path.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view from_here_key = "# from here: ";  ///< second line: the same file as seen from the folder

constexpr std::size_t longest_lines = 16384;  ///< bytes: of two paths, each as long as it may be

}  // namespace

FolderOwner owner_in(const fs::path& mark) {
  std::string begin(longest_lines, '\0');
  std::ifstream file(mark, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t end = std::min(begin.find('\n'), begin.size());
  FolderOwner owner{begin.substr(0, end), ""};
  if (const std::string rest = begin.substr(std::min(end + 1, begin.size())); rest.starts_with(from_here_key))
    owner.from_here = rest.substr(0, rest.find('\n'));
  return owner;
}

FolderOwner owner_by(const std::string& before, const fs::path& folder, const std::vector<fs::path>& files) {
  FolderOwner owner{before, std::string(from_here_key)};
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

FolderOwner maker_of(const fs::path& folder, const std::string& verb, const std::vector<fs::path>& files) {
  return owner_by(verb + " ", folder, files);
}

std::vector<NotedFile> notes_in(const fs::path& folder) {
  std::vector<NotedFile> notes;
  std::ifstream mark(folder / made_by);
  std::string line;
  for (std::getline(mark, line); std::getline(mark, line);)
    if (const auto end = line.find(' '); end != std::string::npos && !line.starts_with(from_here_key))
      notes.push_back({line.substr(0, end), line.substr(end + 1)});
  return notes;
}

void write_mark(const fs::path& folder, const FolderOwner& owner, const std::vector<NotedFile>& notes) {
  std::string mark = owner.line + "\n";
  if (!owner.from_here.empty()) mark += owner.from_here + "\n";
  for (const NotedFile& note : notes) mark += note.line() + "\n";
  write_whole(folder / made_by, mark);
}

}  // namespace tether
