#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tether {

/// A file that values come from.
struct YamlFile {
  std::filesystem::path path;
  int depth = 0;  ///< 0: the case itself, 1: the one that it builds on, ...
};

/// Where something stands, for messages: "case.yaml:12".
struct YamlPlace {
  std::shared_ptr<const YamlFile> file;
  int line = 1;
  std::string text() const;
};

/// A YAML document as plain values that know their place. `empty` is a key without a value.
struct YamlNode {
  enum class Kind { empty, scalar, list, map };
  struct Entry;

  Kind kind = Kind::empty;
  YamlPlace place;              ///< of a list or map below a key: the key's
  std::string text;             ///< of a scalar
  std::vector<YamlNode> items;  ///< of a list
  std::vector<Entry> entries;   ///< of a map, in the order of the file

  const YamlNode* find(std::string_view key) const;
};

struct YamlNode::Entry {
  std::string key;
  YamlPlace place;
  YamlNode value;
  bool is_removed = false;  ///< by a file that builds on this one
};

/// Throws InputError "file:line: ..." for a file that cannot be read, bad syntax, a key given twice, several documents,
/// or nesting beyond any case file's (an alias that contains itself).
YamlNode read_yaml(const std::filesystem::path& file, int depth = 0);

/// A value written as in a file: "[1, 2]", "{a: 1}", "80 mmHg". Throws InputError if it is not YAML.
YamlNode yaml_value(const std::string& text);

/// The document as text; read again it is the same tree. Maps one entry a line, lists in brackets.
std::string yaml_text(const YamlNode& tree);

}  // namespace tether
