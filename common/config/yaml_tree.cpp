#include "common/config/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/name.hpp"
#include "common/base/shortened.hpp"
#include "common/config/named_path.hpp"

namespace tether {
namespace {

constexpr int deepest = 40;
constexpr std::size_t most_values = 100'000;        ///< an alias may stand for many: far beyond any case file
constexpr std::size_t most_entries = 5'000;         ///< of one mapping: each is looked for among the others
constexpr std::uintmax_t largest_file = 2'000'000;  // bytes: each program reads all of them
constexpr std::size_t longest_line = 65'536;        // bytes
constexpr std::size_t most_in_brackets = 1'000;     ///< of a list's values, which then stand on one line
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

int line_of(const YAML::Mark& mark) {
  return mark.line + 1;
}

int line_at(std::string_view text, std::size_t place) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + place, '\n'));
}

/// Where a quoted scalar ends that begins in a text's place; npos: nowhere.
std::size_t closing_quote(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  for (std::size_t at = begin + 1; at < text.size(); ++at) {
    const bool is_escape = quote == '"' ? text[at] == '\\' : text.substr(at, 2) == "''";
    if (is_escape)
      ++at;
    else if (text[at] == quote)
      return at;
  }
  return std::string_view::npos;
}

/// "  - key: value"
bool begins_with_key(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(" -"), line.size());
  const std::size_t end = std::min(line.find(':', begin), line.size());
  const auto is_of_key = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  const std::string_view next = line.substr(end, 2);
  return end > begin && std::all_of(line.begin() + begin, line.begin() + end, is_of_key) &&
         (next == ":" || next == ": " || next == ":\r");
}

/// Whether one of the lines behind a text's first one does.
bool runs_over_keys(std::string_view text) {
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    text.remove_prefix(end + 1);
    if (begins_with_key(text.substr(0, text.find('\n')))) return true;
  }
  return false;
}

/// Looks for what yaml-cpp lets pass: a quote whose end is missing, which takes the lines that follow for its text, and
/// a second document. (YAML::LoadAll cannot count them: of "," it finds one after the other and no end.)
class FirstLook : public YAML::EventHandler {
 public:
  struct Finding {
    int line;
    const char* rule;
  };
  static std::optional<Finding> at(const std::string& text) {
    std::istringstream in(text);
    YAML::Parser parser(in);
    FirstLook look(text);
    try {
      while (look.goes_on() && parser.HandleNextDocument(look)) continue;
    } catch (const YAML::Exception& error) {
      look.look_behind_last(static_cast<std::size_t>(error.mark.pos));
      if (!look.found_) throw;
    }
    return look.found_;
  }

 private:
  explicit FirstLook(std::string_view text)
      : text_(text.substr(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0)) {}
  bool goes_on() const { return documents_ < 2 && !found_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 2 && !found_) found_ = {line_of(mark), "a second document starts here; a case file has one"};
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    behind_last_ = behind_quoted(static_cast<std::size_t>(mark.pos));
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  /// The place behind a quoted scalar, or the one given where there is none.
  std::size_t behind_quoted(std::size_t begin) {
    if (begin >= text_.size() || (text_[begin] != '"' && text_[begin] != '\'')) return begin;
    const std::size_t end = std::min(closing_quote(text_, begin), text_.size());
    if (!found_ && (end == text_.size() || runs_over_keys(text_.substr(begin, end - begin))))
      found_ = {line_at(text_, begin), "a quote is opened here and not closed on this line"};
    return std::min(end + 1, text_.size());
  }
  /// yaml-cpp tells of a scalar in brackets when it has read what follows, where it may find an error.
  void look_behind_last(std::size_t error) {
    constexpr std::string_view before_scalars = " \n[{,";
    for (std::size_t at = std::max<std::size_t>(behind_last_, 1); at < std::min(error, text_.size()); ++at) {
      if (before_scalars.find(text_[at - 1]) == std::string_view::npos) continue;
      if (text_[at] == '#') at = std::min(text_.find('\n', at), text_.size());
      at = std::max(at, behind_quoted(at) - 1);
    }
  }

  std::string_view text_;
  std::size_t behind_last_ = 0;
  int documents_ = 0;
  std::optional<Finding> found_;
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
        throw input_error("{}: '{}' is given twice; first on line {}", place.text(), shortened(key), known->second);
      YamlNode value = (*this)(pair.second, depth + 1);
      if (value.kind != YamlNode::Kind::scalar) value.place = place;
      to.entries.push_back({key, place, std::move(value)});
    }
    return to;
  }

  std::shared_ptr<const YamlFile> file_;
  std::size_t values_ = 0;
};

std::size_t values_in(const YamlNode& node) {
  std::size_t count = 1;
  for (const auto& item : node.items) count += values_in(item);
  for (const auto& entry : node.entries) count += values_in(entry.value);
  return count;
}

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
      out << (values_in(node) > most_in_brackets ? YAML::Block : YAML::Flow) << YAML::BeginSeq;
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

/// The first line that is not UTF-8, or has a character that ends texts (UTF-16 has: yaml-cpp would read it); 0: none.
int first_line_not_text(std::string_view text) {
  const std::size_t zero = text.find('\0');
  const int other = first_line_not_utf8(text);
  return other > 0 || zero == std::string_view::npos ? other : line_at(text, zero);
}

void check_lines(std::string_view text, const std::string& name) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > longest_line)
      throw input_error("{}:{}: has more than {} bytes: must be several lines", name, line_at(text, begin),
                        longest_line);
    begin = end + 1;
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
  if (const int line = first_line_not_text(text.view()); line > 0)
    throw input_error("{}:{}: is not UTF-8; save the file in that encoding", name, line);
  check_lines(text.view(), name);
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
  check_path(file);
  const std::string name = file.string(), text = text_of(file);
  const auto source = std::make_shared<const YamlFile>(YamlFile{file, depth});
  try {
    if (const auto found = FirstLook::at(text)) throw input_error("{}:{}: {}", name, found->line, found->rule);
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
    if (const auto found = FirstLook::at(text)) throw input_error("'{}': {}", shortened(text), found->rule);
    return Copier(nullptr)(YAML::Load(text));
  } catch (const YAML::Exception& error) {
    throw input_error("'{}': not YAML: {}", shortened(text), error.msg);
  }
}

std::string yaml_text(const YamlNode& tree) {
  YAML::Emitter out;
  emit(out, tree);
  return std::string(out.c_str()) + "\n";
}

}  // namespace tether
