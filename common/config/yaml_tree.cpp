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
  explicit Copier(std::shared_ptr<const YamlFile> file) : file_(std::move(file)) {}

  YamlNode operator()(const YAML::Node& from, int depth = 0) const {
    YamlNode to;
    to.place = place_of(from.Mark());
    if (depth > deepest) throw input_error("{}: nested too deeply (an alias that contains itself?)", to.place.text());
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
  YamlPlace place_of(const YAML::Mark& mark) const { return {file_, line_of(mark)}; }

  void add(YamlNode& map, const YAML::Node& key, const YAML::Node& value, int depth) const {
    const YamlPlace place = place_of(key.Mark());
    if (!key.IsScalar()) throw input_error("{}: a name is expected before ':'", place.text());
    for (const auto& entry : map.entries)
      if (entry.key == key.Scalar())
        throw input_error("{}: '{}' is given twice; first on line {}", place.text(), key.Scalar(), entry.place.line);
    map.entries.push_back({key.Scalar(), place, (*this)(value, depth + 1)});
    if (map.entries.back().value.kind != YamlNode::Kind::scalar) map.entries.back().value.place = place;
  }

  std::shared_ptr<const YamlFile> file_;
};

/// Scalars that YAML would take for nothing keep their quotes: yaml-cpp sees to it.
void emit(YAML::Emitter& out, const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::empty:
      out << YAML::Null;
      break;
    case YamlNode::Kind::scalar:
      out << node.text;
      break;
    case YamlNode::Kind::list:
      out << YAML::Flow << YAML::BeginSeq;
      for (const auto& item : node.items) emit(out, item);
      out << YAML::EndSeq;
      break;
    case YamlNode::Kind::map:
      out << YAML::BeginMap;
      for (const auto& entry : node.entries) {
        out << YAML::Key << entry.key << YAML::Value;
        emit(out, entry.value);
      }
      out << YAML::EndMap;
      break;
  }
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const auto& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

std::string YamlPlace::text() const {
  return fmt::format("{}:{}", file ? file->path.string() : "", line);
}

YamlNode read_yaml(const std::filesystem::path& file, int depth) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file)) throw input_error("{}: no such file", name);
  if (!std::filesystem::is_regular_file(file)) throw input_error("{}: is not a file", name);
  const auto source = std::make_shared<const YamlFile>(YamlFile{file, depth});
  try {
    const auto documents = YAML::LoadAllFromFile(name);
    if (documents.size() > 1)
      throw input_error("{}:{}: a second document starts here; a case file has one", name,
                        line_of(documents[1].Mark()));
    YamlNode nothing;
    nothing.place = {source, 1};
    return documents.empty() ? nothing : Copier(source)(documents.front());
  } catch (const YAML::BadFile&) {
    throw input_error("{}: cannot be read", name);
  } catch (const YAML::Exception& error) {
    throw input_error("{}:{}: not YAML: {}", name, line_of(error.mark), error.msg);
  }
}

YamlNode yaml_value(const std::string& text) {
  try {
    return Copier(nullptr)(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    throw input_error("'{}': not YAML: {}", text, error.msg);
  }
}

std::string yaml_text(const YamlNode& tree) {
  YAML::Emitter out;
  emit(out, tree);
  return std::string(out.c_str()) + "\n";
}

}  // namespace tether
