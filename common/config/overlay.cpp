#include "common/config/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"
#include "common/config/named_path.hpp"
#include "common/config/yaml_tree.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

YamlNode scalar(const std::string& text) {
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.text = text;
  return node;
}

YamlNode& entry_of(YamlNode& map, const std::string& key) {
  for (auto& entry : map.entries)
    if (entry.key == key) return entry.value;
  return map.entries.emplace_back(YamlNode::Entry{key, {}, {}}).value;
}

/// Sections grow on the way to the field.
void set(YamlNode& tree, const Overlay::Value& value) {
  YamlNode* node = &tree;
  for (std::size_t begin = 0; begin <= value.field.size();) {
    const std::size_t end = std::min(value.field.find('.', begin), value.field.size());
    if (end == begin) throw input_error("'{}': a name is missing beside a dot", value.field);
    node->kind = YamlNode::Kind::map;
    const std::size_t before = node->entries.size();
    YamlNode& next = entry_of(*node, value.field.substr(begin, end - begin));
    const bool is_new = node->entries.size() > before, is_last = end == value.field.size();
    if (!is_new && (is_last || next.kind != YamlNode::Kind::map))
      throw input_error("{}: is given twice, or lies within a field that is", value.field);
    node = &next;
    begin = end + 1;
  }
  *node = yaml_value(value.text);
}

/// Of a scalar or list without the line's end that a document has.
std::string text_of(const YamlNode& node) {
  std::string text = yaml_text(node);
  text.pop_back();
  return node.kind == YamlNode::Kind::empty ? "" : text;
}

void collect(const YamlNode& map, const std::string& path, std::vector<Overlay::Value>& values) {
  for (const auto& entry : map.entries) {
    const std::string field = path.empty() ? entry.key : path + "." + entry.key;
    if (entry.value.kind == YamlNode::Kind::map)
      collect(entry.value, field, values);
    else
      values.push_back({field, text_of(entry.value)});
  }
}

}  // namespace

std::string number_text(double value) {
  return fmt::format("{}", value);
}

void write_overlay(const fs::path& file, const Overlay& overlay) {
  YamlNode tree;
  tree.kind = YamlNode::Kind::map;
  entry_of(tree, "base") = scalar(name_for(overlay.base, fs::absolute(file).parent_path()));
  entry_of(tree, "name") = scalar(overlay.name);
  if (!overlay.title.empty()) entry_of(tree, "title") = scalar(overlay.title);
  for (const auto& value : overlay.values) set(tree, value);
  const std::string text = yaml_text(tree);
  std::ofstream to(file);
  to << text;
  to.close();
  if (!to) throw write_error(file);
}

std::vector<Overlay::Value> values_of_overlay(const fs::path& file) {
  YamlNode tree = read_yaml(file);
  std::erase_if(tree.entries,
                [](const auto& entry) { return entry.key == "base" || entry.key == "name" || entry.key == "title"; });
  std::vector<Overlay::Value> values;
  collect(tree, {}, values);
  return values;
}

void set_value(std::vector<Overlay::Value>& values, const Overlay::Value& value) {
  const auto known = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.field == value.field; });
  if (known == values.end())
    values.push_back(value);
  else
    known->text = value.text;
}

}  // namespace tether
