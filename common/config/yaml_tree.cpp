#include "common/config/yaml_tree.hpp"

#include <yaml-cpp/yaml.h>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr int deepest = 40;

int line_of(const YAML::Mark& mark) {
  return mark.line + 1;
}

/// Copies yaml-cpp's nodes, looking for what it lets pass.
class Copier {
 public:
  explicit Copier(const std::string& file) : file_(file) {}

  YamlNode operator()(const YAML::Node& from, int depth = 0) const {
    YamlNode to;
    to.line = line_of(from.Mark());
    if (depth > deepest) throw input_error("{}:{}: nested too deeply (an alias that contains itself?)", file_, to.line);
    if (from.IsScalar()) {
      to.kind = YamlNode::Kind::scalar;
      to.text = from.Scalar();
    } else if (from.IsSequence()) {
      to.kind = YamlNode::Kind::list;
      for (const auto& item : from) to.items.push_back((*this)(item, depth + 1));
    } else if (from.IsMap()) {
      to.kind = YamlNode::Kind::map;
      for (const auto& pair : from) add(to, pair.first, pair.second, depth);
    }
    return to;
  }

 private:
  void add(YamlNode& map, const YAML::Node& key, const YAML::Node& value, int depth) const {
    const int line = line_of(key.Mark());
    if (!key.IsScalar()) throw input_error("{}:{}: a name is expected before ':'", file_, line);
    for (const auto& entry : map.entries)
      if (entry.key == key.Scalar())
        throw input_error("{}:{}: '{}' is given twice; first on line {}", file_, line, key.Scalar(), entry.line);
    map.entries.push_back({key.Scalar(), line, (*this)(value, depth + 1)});
    if (map.entries.back().value.kind != YamlNode::Kind::scalar) map.entries.back().value.line = line;
  }

  const std::string& file_;
};

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const auto& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

YamlNode read_yaml(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file)) throw input_error("{}: no such file", name);
  if (!std::filesystem::is_regular_file(file)) throw input_error("{}: is not a file", name);
  try {
    const auto documents = YAML::LoadAllFromFile(name);
    if (documents.size() > 1)
      throw input_error("{}:{}: a second document starts here; a case file has one", name,
                        line_of(documents[1].Mark()));
    return documents.empty() ? YamlNode{} : Copier(name)(documents.front());
  } catch (const YAML::BadFile&) {
    throw input_error("{}: cannot be read", name);
  } catch (const YAML::Exception& error) {
    throw input_error("{}:{}: not YAML: {}", name, line_of(error.mark), error.msg);
  }
}

}  // namespace tether
