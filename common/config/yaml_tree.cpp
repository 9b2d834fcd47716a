#include "common/config/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/name.hpp"

namespace tether {
namespace {

constexpr int deepest = 40;
constexpr std::size_t most_values = 100'000;         ///< an alias may stand for many: far beyond any case file
constexpr std::size_t most_entries = 5'000;          ///< of one mapping: each is looked for among the others
constexpr std::uintmax_t largest_file = 10'000'000;  // bytes

int line_of(const YAML::Mark& mark) {
  return mark.line + 1;
}

/// Counts documents, which YAML::LoadAll cannot: of "," it finds one after the other and no end.
class Documents : public YAML::EventHandler {
 public:
  /// Where the second one begins. What stands behind the first one's end and is none counts as well.
  static std::optional<YAML::Mark> second_of(const std::string& text) {
    std::istringstream in(text);
    YAML::Parser parser(in);
    Documents documents;
    while (documents.starts_.size() < 2 && parser.HandleNextDocument(documents)) continue;
    return documents.starts_.size() < 2 ? std::nullopt : std::optional(documents.starts_[1]);
  }

 private:
  void OnDocumentStart(const YAML::Mark& mark) override { starts_.push_back(mark); }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  std::vector<YAML::Mark> starts_;
};

/// Copies yaml-cpp's nodes, looking for what it lets pass.
class Copier {
 public:
  explicit Copier(std::shared_ptr<const YamlFile> file) : file_(std::move(file)) {}

  YamlNode operator()(const YAML::Node& from, int depth = 0) {
    YamlNode to;
    to.place = place_of(from.Mark());
    if (depth > deepest) throw input_error("{}: nested too deeply (an alias that contains itself?)", to.place.text());
    if (++values_ > most_values)
      throw input_error("{}: more than {} values (aliases of aliases?)", to.place.text(), most_values);
    if (from.IsScalar()) {
      to.kind = YamlNode::Kind::scalar;
      to.text = from.Scalar();
    } else if (from.IsSequence()) {
      to.kind = YamlNode::Kind::list;
      for (const auto& item : from) to.items.push_back((*this)(item, depth + 1));
    } else if (from.IsMap()) {
      to.kind = YamlNode::Kind::map;
      if (from.size() > most_entries)
        throw input_error("{}: more than {} entries in one mapping", to.place.text(), most_entries);
      return map_of(from, std::move(to), depth);
    }
    return to;
  }

 private:
  YamlPlace place_of(const YAML::Mark& mark) const { return {file_, line_of(mark)}; }

  YamlNode map_of(const YAML::Node& from, YamlNode to, int depth) {
    std::map<std::string, int> lines;
    for (const auto& pair : from) {
      const YamlPlace place = place_of(pair.first.Mark());
      if (!pair.first.IsScalar()) throw input_error("{}: a name is expected before ':'", place.text());
      const std::string& key = pair.first.Scalar();
      if (const auto [known, is_new] = lines.emplace(key, place.line); !is_new)
        throw input_error("{}: '{}' is given twice; first on line {}", place.text(), key, known->second);
      YamlNode value = (*this)(pair.second, depth + 1);
      if (value.kind != YamlNode::Kind::scalar) value.place = place;
      to.entries.push_back({key, place, std::move(value)});
    }
    return to;
  }

  std::shared_ptr<const YamlFile> file_;
  std::size_t values_ = 0;
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

/// Throws InputError for a file that cannot be read, is far too large, or is not UTF-8.
std::string text_of(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::ifstream from = input_stream(file, std::ios::binary);
  if (std::filesystem::file_size(file) > largest_file)
    throw input_error("{}: has more than {} bytes: is it a case file?", name, largest_file);
  std::ostringstream text;
  text << from.rdbuf();
  if (!from) throw input_error("{}: cannot be read", name);
  if (const int line = first_line_not_utf8(text.str()); line > 0)
    throw input_error("{}:{}: is not UTF-8; save the file in that encoding", name, line);
  return text.str();
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
  const std::string name = file.string(), text = text_of(file);
  const auto source = std::make_shared<const YamlFile>(YamlFile{file, depth});
  try {
    if (const auto second = Documents::second_of(text))
      throw input_error("{}:{}: a second document starts here; a case file has one", name, line_of(*second));
    const YAML::Node document = YAML::Load(text);
    YamlNode nothing;
    nothing.place = {source, 1};
    return document.IsNull() ? nothing : Copier(source)(document);
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
