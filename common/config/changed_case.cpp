#include "common/config/changed_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/shortened.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_told = 5;

std::string one_line(const YamlNode& value) {
  std::string text = yaml_text(value);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Values by their fields.
void add_values(const YamlNode& node, const std::string& field, std::map<std::string, std::string>& values) {
  if (node.kind != YamlNode::Kind::map) {
    values[field] = node.kind == YamlNode::Kind::scalar ? node.text : one_line(node);
    return;
  }
  for (const YamlNode::Entry& entry : node.entries)
    add_values(entry.value, field.empty() ? entry.key : field + "." + entry.key, values);
}

std::map<std::string, std::string> values_of(const YamlNode& tree) {
  std::map<std::string, std::string> values;
  add_values(tree, "", values);
  for (const char* of_no_run : {"name", "title"}) values.erase(of_no_run);
  return values;
}

std::string value_in(const std::map<std::string, std::string>& values, const std::string& field) {
  const auto found = values.find(field);
  return found == values.end() ? "none" : shortened(found->second);
}

std::vector<std::string> changed_values(const YamlNode& then, const YamlNode& now) {
  const std::map<std::string, std::string> before = values_of(then), after = values_of(now);
  std::map<std::string, std::string> all = before;
  all.insert(after.begin(), after.end());
  std::vector<std::string> changes;
  for (const auto& [field, value] : all)
    if (const std::string was = value_in(before, field), is = value_in(after, field); was != is)
      changes.push_back(fmt::format("{}: {} now, {} before", field, is, was));
  return changes;
}

std::vector<std::string> files_written_since(fs::file_time_type begun, const fs::path& case_file) {
  std::vector<std::string> files;
  std::error_code none;
  std::set<fs::path> read = files_read(case_file);
  for (const fs::path& of_case : files_of_case(case_file))
    std::erase_if(read, [&](const fs::path& file) { return fs::equivalent(file, of_case, none); });
  for (const fs::path& file : read)
    if (fs::last_write_time(file, none) > begun && !none)
      files.push_back(fmt::format("{}: written since", file.string()));
  return files;
}

std::string in_short(const std::vector<std::string>& all) {
  const std::size_t told = std::min(all.size(), most_told);
  std::string text = fmt::format("{}", fmt::join(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(told), "; "));
  if (told < all.size()) text += fmt::format("; and {} more", all.size() - told);
  return text;
}

}  // namespace

std::string told_changes(const fs::path& results, const fs::path& case_file) {
  const fs::path as_run = results / case_as_run;
  std::error_code none;
  const fs::file_time_type begun = fs::last_write_time(as_run, none);
  if (none) return {};
  try {
    const std::vector<std::string> changes = changed_values(read_yaml(as_run), as_one_file(read_case_tree(case_file)));
    return in_short(changes.empty() ? files_written_since(begun, case_file) : changes);
  } catch (const InputError&) {  // of a copy that somebody has changed nothing is told
    return {};
  }
}

}  // namespace tether
