#include "common/config/input_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_set>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/base/hash_file.hpp"
#include "common/base/lower_case.hpp"
#include "common/base/newest_state.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/named_path.hpp"
#include "common/config/output_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t begin_of_hash = 14695981039346656037ull;
constexpr std::size_t most_names = 100'000;  ///< that a list is searched for: of 5,000 surfaces, each in some ways
constexpr std::size_t longest_path = 4096;   ///< bytes, of the system
constexpr int folders_deep = 1;              ///< those of meshes have their surfaces one below

std::uint64_t hash_text(std::string_view text, std::uint64_t seed) {
  return hash_bytes(text.data(), text.size(), hash_bytes("|", 1, seed));
}

bool is_number(std::string_view text) {
  double value = 0;
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && last == text.data() + text.size();
}

std::string with_xml_entities_read(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> entities{
      {{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&apos;", "'"}, {"&amp;", "&"}}};
  for (const auto& [entity, character] : entities)
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; at += character.size())
      text.replace(at, entity.size(), character);
  return text;
}

/// Without blanks and quotes around it.
std::string bare(std::string_view text) {
  constexpr std::string_view around = " \"'";
  const std::size_t begin = std::min(text.find_first_not_of(around), text.size());
  return std::string(text.substr(begin, text.find_last_not_of(around) + 1 - begin));
}

std::vector<fs::path> inside(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder, fs::directory_options::skip_permission_denied))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::uint64_t hash_folder(const fs::path& folder, std::uint64_t hash, int deep) {
  for (const fs::path& path : inside(folder)) {
    hash = hash_text(path.filename().string(), hash);
    if (fs::is_regular_file(path)) hash = hash_file(path, hash);
    if (fs::is_directory(path) && deep > 0) hash = hash_folder(path, hash, deep - 1);
  }
  return hash;
}

/// Of a folder that the case stands in: the files, and as deep as said those of its folders, but not results, which may
/// stand there too, nor that there are folders.
std::uint64_t hash_around_case(const fs::path& folder, std::uint64_t hash, int deep) {
  for (const fs::path& path : inside(folder)) {
    if (fs::is_regular_file(path)) hash = hash_file(path, hash_text(path.filename().string(), hash));
    if (fs::is_directory(path) && deep > 0 && !fs::exists(path / case_as_run))
      hash = hash_around_case(path, hash, deep - 1);
  }
  return hash;
}

/// The codes' states in a checkpoint, not what the run has cost.
std::uint64_t hash_state(const fs::path& checkpoint) {
  return hash_file(checkpoint / "solid.bin", hash_file(checkpoint / "fluid.bin", begin_of_hash));
}

constexpr std::string_view initial_state = "initial_state";  ///< the section that names a run for its state

/// A mesh may stand beside its case, with its surfaces in a folder below.
std::uint64_t content_for(const fs::path& path, const std::string& field, const fs::path& case_folder) {
  std::error_code none;
  if (field.starts_with(initial_state))
    if (const fs::path state = newest_state(path); fs::is_directory(state, none)) return hash_state(state);
  const fs::path from_it = fs::canonical(case_folder, none).lexically_relative(fs::canonical(path, none));
  const bool is_mesh = field == "mesh" || field.starts_with("mesh.");
  const bool holds_case = fs::is_directory(path, none) && !from_it.empty() && *from_it.begin() != "..";
  return holds_case ? hash_around_case(path, begin_of_hash, is_mesh ? folders_deep : 0) : hash_content(path);
}

/// What a value of a case names.
struct NamedInput {
  std::string field, name;
  fs::path path;
};

void gather(const YamlNode& node, const std::string& field, const fs::path& folder, std::vector<NamedInput>& found) {
  std::error_code none;
  if (node.kind == YamlNode::Kind::scalar && !node.text.empty() && !is_number(node.text) &&
      fs::exists(folder / node.text, none))
    found.push_back({field, node.text, named_path(folder, node.text)});
  for (const YamlNode& item : node.items) gather(item, field, folder, found);
  for (const YamlNode::Entry& entry : node.entries) gather(entry.value, field + "." + entry.key, folder, found);
}

bool is_mesh(const fs::path& file) {
  constexpr std::array<std::string_view, 7> kinds{".vtu", ".vtp", ".vtk", ".stl", ".ply", ".obj", ".msh"};
  return std::find(kinds.begin(), kinds.end(), lower_case(file.extension().string())) != kinds.end();
}

fs::path folder_of(const fs::path& case_file) {
  return fs::absolute(case_file).parent_path();
}

std::vector<NamedInput> inputs_of(const fs::path& case_file) {
  const YamlNode tree = as_one_file(read_case_tree(case_file));
  std::vector<NamedInput> found;
  for (const auto& entry : tree.entries)
    if (entry.value.kind != YamlNode::Kind::scalar) gather(entry.value, entry.key, folder_of(case_file), found);
  return found;
}

/// Beside a mesh may stand what is being written: results, a log.
void add_meshes_in(const fs::path& folder, int deep, std::set<fs::path>& files) {
  for (const fs::path& path : inside(folder)) {
    if (fs::is_regular_file(path) && is_mesh(path)) files.insert(path);
    if (fs::is_directory(path) && deep > 0 && !fs::exists(path / case_as_run)) add_meshes_in(path, deep - 1, files);
  }
}

/// Files count by what they hold, and their folders do not: a case may be moved.
void look_into_files(nlohmann::json& value, const std::string& field) {
  if (value.is_string() && value.get_ref<const std::string&>().starts_with('/')) {
    const std::filesystem::path path = value.get<std::string>();
    value = nlohmann::json::array({path.filename().string(), content_for(path, field, "/")});
  } else if (value.is_object()) {
    for (auto& [key, item] : value.items()) look_into_files(item, field.empty() ? key : field);
  } else if (value.is_array()) {
    for (auto& item : value) look_into_files(item, field);
  }
}

std::string essence(const std::string& effective_case) {
  nlohmann::json json = nlohmann::json::parse(effective_case, nullptr, false);
  if (json.is_discarded()) return effective_case;  // an external code's own format
  if (json.is_object()) {
    for (const char* name : {"output", "coupling", "title"}) json.erase(name);
    if (json.contains("time") && json["time"].is_object()) json["time"].erase("end");
  }
  look_into_files(json, {});
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

/// Whatever text between two of some marks is the name of a file counts. A name may hold the other marks. Each is
/// looked for once, and so many as no list of surfaces has that is read: a table of a million rows may be text in all
/// of them.
std::set<fs::path> files_named_in(const fs::path& list) {
  const std::string kind = lower_case(list.extension().string());
  if (kind != ".csv" && kind != ".pvd") return {};
  std::set<fs::path> found;
  std::unordered_set<std::string> seen;
  const auto add_if_file = [&](const std::string& name) {
    std::error_code none;
    if (!name.empty() && name.size() <= longest_path && !is_number(name) && seen.insert(name).second &&
        fs::is_regular_file(list.parent_path() / name, none))
      found.insert(list.parent_path() / name);
  };
  std::ifstream file(list);
  for (std::string line, before; seen.size() < most_names && std::getline(file, line); std::swap(line, before)) {
    if (line == before) continue;
    for (const std::string_view marks : {",;\t\r", "\"", "'", ",\"'\t\r"})
      for (std::size_t begin = 0; begin < line.size() && seen.size() < most_names;) {
        const std::size_t end = std::min(line.find_first_of(marks, begin), line.size());
        const std::string text = bare(std::string_view(line).substr(begin, end - begin));
        add_if_file(text);
        if (text.find('&') != std::string::npos) add_if_file(with_xml_entities_read(text));
        begin = end + 1;
      }
  }
  return found;
}

std::uint64_t hash_content(const fs::path& path) {
  std::error_code none;
  if (fs::is_directory(path, none)) return hash_folder(path, begin_of_hash, folders_deep);
  if (!fs::is_regular_file(path, none)) return 0;
  std::uint64_t hash = hash_file(path, begin_of_hash);
  for (const fs::path& named : files_named_in(path))
    hash = hash_file(named, hash_text(named.filename().string(), hash));
  return hash;
}

std::vector<InputFile> input_files(const fs::path& case_file) {
  std::vector<InputFile> all;
  for (const auto& [field, name, path] : inputs_of(case_file))
    all.push_back({field, name, content_for(path, field, folder_of(case_file))});
  return all;
}

std::vector<std::string> data_hashes(const fs::path& case_file) {
  std::vector<std::string> all;
  for (const InputFile& input : input_files(case_file))
    if (input.field.starts_with("observations.")) all.push_back(fmt::format("{:016x}", input.content));
  return all;
}

std::set<fs::path> files_read(const fs::path& case_file) {
  std::set<fs::path> all;
  for (const fs::path& file : files_of_case(case_file)) all.insert(fs::absolute(file));
  for (const auto& [field, name, path] : inputs_of(case_file)) {
    if (fs::is_directory(path) && !fs::exists(path / case_as_run)) add_meshes_in(path, folders_deep, all);
    if (!fs::is_regular_file(path)) continue;
    all.insert(path);
    all.merge(files_named_in(path));
  }
  return all;
}

std::set<fs::path> folders_read(const fs::path& case_file) {
  std::set<fs::path> all;
  for (const auto& [field, name, path] : inputs_of(case_file)) {
    const std::string section = field.substr(0, field.find('.'));
    if (fs::is_directory(path) && (section == initial_state || section == "mesh" || section == "observations"))
      all.insert(path);
  }
  return all;
}

std::uint64_t hash_files_read(const fs::path& case_file) {
  try {
    std::uint64_t hash = hash_bytes(nullptr, 0);
    for (const fs::path& file : files_read(case_file)) {
      const std::uint64_t content = hash_content(file);
      hash = hash_bytes(&content, sizeof content, hash);
    }
    return hash;
  } catch (const InputError&) {
    return 0;
  }
}

std::uint64_t hash_case(const std::string& effective_case, std::uint64_t seed) {
  const std::string text = essence(effective_case);
  return hash_bytes(text.data(), text.size(), seed);
}

}  // namespace tether
