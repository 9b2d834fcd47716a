#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tether {

/// A YAML document as plain values that know their line. `empty` is a key without a value.
struct YamlNode {
  enum class Kind { empty, scalar, list, map };
  struct Entry;

  Kind kind = Kind::empty;
  int line = 1;                 ///< of a list or map below a key: the key's line
  std::string text;             ///< of a scalar
  std::vector<YamlNode> items;  ///< of a list
  std::vector<Entry> entries;   ///< of a map, in the order of the file

  const YamlNode* find(std::string_view key) const;
};

struct YamlNode::Entry {
  std::string key;
  int line = 1;
  YamlNode value;
};

/// Throws InputError "file:line: ..." for a file that cannot be read, bad syntax, a key given twice, several documents,
/// or nesting beyond any case file's (an alias that contains itself).
YamlNode read_yaml(const std::filesystem::path& file);

}  // namespace tether
