#include "common/config/case_tree.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/shortened.hpp"
#include "common/config/named_path.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr int most_bases = 16;

YamlNode::Entry* entry_of(YamlNode& map, const std::string& key) {
  const auto found = std::find_if(map.entries.begin(), map.entries.end(), [&](const auto& e) { return e.key == key; });
  return found == map.entries.end() ? nullptr : &*found;
}

/// Puts `over` upon `under`.
void merge(YamlNode& under, const YamlNode& over) {
  using Kind = YamlNode::Kind;
  if (under.kind != Kind::map || over.kind != Kind::map) {
    under = over;
    return;
  }
  under.place = over.place;
  for (const auto& entry : over.entries) {
    YamlNode::Entry* known = entry_of(under, entry.key);
    if (!known) {
      under.entries.push_back(entry);
    } else if (entry.value.kind == Kind::empty) {
      known->value = entry.value;
      known->is_removed = true;
    } else {
      known->place = entry.place;
      known->is_removed = false;
      merge(known->value, entry.value);
    }
  }
}

/// What a file removed may be removed again, or given anew, by those that build on it: only then it is left out.
void leave_out_removed(YamlNode& node) {
  std::erase_if(node.entries, [](const auto& entry) { return entry.is_removed; });
  for (auto& entry : node.entries) leave_out_removed(entry.value);
}

/// Bare numbers of the base would be taken in the other unit.
void check_units(const YamlNode& under, const YamlNode& over) {
  const YamlNode *base = under.find("units"), *own = over.find("units");
  if (base && own && own->kind == YamlNode::Kind::scalar && own->text != base->text)
    throw input_error(
        "{}: units: {}: must be the base's ({}), whose numbers would be taken in these; leave it out, and "
        "write numbers with their unit where it differs",
        own->place.text(), shortened(own->text), shortened(base->text));
}

/// The path that `base` names; empty if there is none.
fs::path base_of(const YamlNode& tree) {
  const YamlNode* base = tree.find("base");
  if (!base) return {};
  if (base->kind != YamlNode::Kind::scalar || base->text.empty())
    throw input_error("{}: base: must be the path of a case file", base->place.text());
  const fs::path path = named_path(base->place.file->path.parent_path(), base->text);
  if (!fs::is_regular_file(path))
    throw input_error("{}: base: {}: {}", base->place.text(), path.string(),
                      fs::is_directory(path) ? "is a folder: must be a case file"
                      : fs::exists(path)     ? "is a device or a pipe: must be a case file"
                                             : "no such file");
  return path;
}

/// The files of a case as trees, itself first.
std::vector<YamlNode> chain_of(const fs::path& file) {
  std::vector<YamlNode> chain;
  for (fs::path next = file; !next.empty(); next = base_of(chain.back())) {
    const auto again = std::any_of(chain.begin(), chain.end(),
                                   [&](const YamlNode& tree) { return fs::equivalent(tree.place.file->path, next); });
    const std::string where = chain.empty() ? "" : chain.back().find("base")->place.text();
    if (again) throw input_error("{}: base: {}: a case cannot build on itself", where, next.string());
    if (chain.size() > most_bases)
      throw input_error("{}: base: more than {} files build on each other", where, most_bases);
    chain.push_back(read_yaml(next, static_cast<int>(chain.size())));
  }
  return chain;
}

void move_paths(YamlNode& node, const fs::path& folder) {
  if (node.kind == YamlNode::Kind::scalar && node.place.file->depth > 0 && !node.text.empty()) {
    std::error_code none;
    const fs::path named = named_path(node.place.file->path.parent_path(), node.text);
    if (fs::exists(named, none)) node.text = name_for(named, folder);
  }
  for (auto& item : node.items) move_paths(item, folder);
  for (auto& entry : node.entries) move_paths(entry.value, folder);
}

}  // namespace

YamlNode read_case_tree(const fs::path& file) {
  std::vector<YamlNode> chain = chain_of(file);
  YamlNode tree = std::move(chain.back());
  for (chain.pop_back(); !chain.empty(); chain.pop_back()) {
    YamlNode& over = chain.back();
    std::erase_if(over.entries, [](const auto& entry) { return entry.key == "base"; });
    check_units(tree, over);
    merge(tree, over);
  }
  leave_out_removed(tree);
  return tree;
}

std::vector<fs::path> files_of_case(const fs::path& file) {
  std::vector<fs::path> files;
  for (const YamlNode& tree : chain_of(file)) files.push_back(tree.place.file->path);
  return files;
}

std::string case_text(const fs::path& file) {
  std::ostringstream text;
  const std::vector<fs::path> files = files_of_case(file);
  if (files.size() == 1) {
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  for (std::size_t i = 1; i < files.size(); ++i) text << "# Merged with " << place_of(files[i]).string() << "\n";
  text << yaml_text(as_one_file(read_case_tree(file)));
  return text.str();
}

YamlNode as_one_file(YamlNode tree) {
  const fs::path folder = fs::absolute(tree.place.file->path).parent_path();
  for (auto& entry : tree.entries)
    if (entry.value.kind != YamlNode::Kind::scalar) move_paths(entry.value, folder);
  return tree;
}

}  // namespace tether
