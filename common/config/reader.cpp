#include "common/config/reader.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "common/base/error.hpp"
#include "common/base/given_number.hpp"
#include "common/base/name.hpp"
#include "common/base/shortened.hpp"
#include "common/config/named_path.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

const char* described(YamlNode::Kind kind) {
  switch (kind) {
    case YamlNode::Kind::scalar:
      return "a single value";
    case YamlNode::Kind::list:
      return "a list";
    case YamlNode::Kind::map:
      return "a section";
    default:
      return "nothing";
  }
}

std::string with_meaning(std::string_view meaning) {
  return meaning.empty() ? "" : fmt::format(" ({})", meaning);
}

/// The value as the user wrote it, followed by the unit it is taken in if it is a bare number.
std::string with_unit(const std::string& text, const std::string& unit) {
  const bool bare = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
  return bare && !unit.empty() ? text + " " + unit : text;
}

/// Which rule a number breaks; empty: none.
std::string rule_broken(double value, Dimension dimension, const Range& range) {
  if (!std::isfinite(value)) return "must be finite";
  if (!range.contains(value)) return rule_of(range);
  const double size = std::abs(value);
  if (size > largest_given) return fmt::format("must be from -{:g} to {:g}", largest_given, largest_given);
  const bool is_divisor = dimension != dimension::none || !range.contains(0.0);
  if (value == 0.0 || size >= smallest_given || !is_divisor) return {};
  return fmt::format("is too near to zero: must be {:g} or more away{}", smallest_given,
                     range.contains(0.0) ? ", or zero" : "");
}

}  // namespace

void Problems::add(const YamlPlace& place, std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  constexpr std::size_t longest = 2000;  // bytes: a value may be a page
  if (text.size() > longest) text = text.substr(0, longest / 2) + " ... " + text.substr(text.size() - longest / 2);
  found_.emplace_back(place, std::move(text));
}

void Problems::throw_if_any() {
  std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.file->depth, a.first.line) < std::pair(b.first.file->depth, b.first.line);
  });
  std::vector<std::string> lines;
  for (const auto& [place, text] : found_)
    if (lines.size() < most_told) lines.push_back(fmt::format("{}: {}", place.text(), text));
  if (are_many()) lines.push_back(fmt::format("and {} more like these", found_.size() - most_told));
  if (!lines.empty()) throw input_error("{}", fmt::join(lines, "\n"));
}

Reader::Reader(const YamlNode& root, const UnitSystem& units, Problems& problems) : units_(units), problems_(problems) {
  Section& whole = sections_.emplace_back();
  whole.node = &root;
  whole.place = {root.place.file, 1};
}

std::string Reader::unit(Dimension dimension) const {
  return dimension == dimension::none ? "" : units_.symbol(dimension);
}

void Reader::wrong(const Field& field, const YamlPlace& place, const std::string& value, const std::string& rule) {
  Section& section = sections_.back();
  section.failed = true;
  const std::string shown = value.empty() ? "" : shortened(value) + ": ";
  problems_.add(place, fmt::format("{}{}: {}{}{}", section.path, field.name, shown, rule, with_meaning(field.meaning)));
}

const Reader::Condition* Reader::broken_condition() const {
  for (const auto& condition : conditions_)
    if (!condition.holds) return &condition;
  return nullptr;
}

/// The value of a field, or null where there is none to read; a missing value that must be given is reported.
const YamlNode* Reader::find(const Field& field) {
  Section& section = sections_.back();
  const std::string name(field.name);
  if (const Condition* broken = broken_condition()) {
    auto [known, added] = section.inapplicable.emplace(name, *broken);
    if (!added) known->second.words += " or " + broken->words;
    return nullptr;
  }
  section.known.push_back(name);
  const YamlNode* node = section.node ? section.node->find(name) : nullptr;
  if (node && node->kind != YamlNode::Kind::empty) return node;
  if (field.required) {
    const std::string unit = field.unit.empty() ? "" : fmt::format(" in {}", field.unit);
    wrong(field, node ? node->place : section.place, "missing", "must be given" + unit);
  }
  return nullptr;
}

const YamlNode* Reader::scalar(const Field& field) {
  const YamlNode* node = find(field);
  if (!node || node->kind == YamlNode::Kind::scalar) return node;
  wrong(field, node->place, described(node->kind), "must be a single value");
  return nullptr;
}

std::optional<double> Reader::quantity(const Field& field, const YamlNode& node, Dimension dimension,
                                       const Range& range) {
  double value = undefined;
  try {
    value = units_.quantity(node.text, dimension);
  } catch (const InputError& error) {
    wrong(field, node.place, "", shortened(error.what(), 200));  // it quotes the value and lists units
    return std::nullopt;
  }
  const std::string rule = rule_broken(value, dimension, range);
  if (rule.empty()) return value;
  wrong(field, node.place, with_unit(node.text, field.unit), rule);
  return std::nullopt;
}

void Reader::number(Text name, double& value, Dimension dimension, Range range, Text meaning) {
  const Field field{name, meaning, unit(dimension), std::isnan(value)};
  if (const YamlNode* node = scalar(field)) value = quantity(field, *node, dimension, range).value_or(value);
}

void Reader::number(Text name, std::optional<double>& value, Dimension dimension, Range range, Text meaning) {
  const Field field{name, meaning, unit(dimension)};
  const YamlNode* node = scalar(field);
  if (!node) return;
  if (const auto read = quantity(field, *node, dimension, range)) value = read;
}

void Reader::integer(Text name, int& value, IntegerRange range, Text meaning) {
  const Field field{name, meaning, ""};
  const YamlNode* node = scalar(field);
  if (!node) return;
  int read = 0;
  const char* end = node->text.data() + node->text.size();
  const auto [last, error] = std::from_chars(node->text.data(), end, read);
  const bool is_large = error == std::errc::result_out_of_range && last == end;
  if (!is_large && (error != std::errc{} || last != end))
    return wrong(field, node->place, node->text, "must be a whole number");
  if (is_large || read < range.lower || read > range.upper)
    return wrong(field, node->place, node->text, rule_of(as_range(range)));
  value = read;
}

void Reader::flag(Text name, bool& value, Text meaning) {
  const Field field{name, meaning, ""};
  const YamlNode* node = scalar(field);
  if (!node) return;
  const auto is = [&](auto... words) { return ((node->text == words) || ...); };
  if (!is("true", "yes", "on", "false", "no", "off"))
    return wrong(field, node->place, node->text, "must be true or false");
  value = is("true", "yes", "on");
}

void Reader::text(Text name, std::string& value, Text meaning, Need need) {
  const YamlNode* node = scalar({name, meaning, "", need == Need::required && value.empty()});
  if (node) value = node->text;
}

void Reader::choice(Text name, std::string& value, std::span<const Word> words, Text meaning) {
  const Field field{name, meaning, "", value.empty()};
  const YamlNode* node = scalar(field);
  if (!node) return;
  std::vector<std::string> known;
  for (const auto& word : words) known.emplace_back(word.word);
  if (std::find(known.begin(), known.end(), node->text) != known.end()) {
    value = node->text;
    return;
  }
  const std::string near = nearest(node->text, known);
  value.clear();  // no guess: fields that depend on it are then neither asked for nor refused
  const std::string hint = near.empty() ? "" : fmt::format("; did you mean '{}'?", near);
  wrong(field, node->place, node->text, fmt::format("must be one of {}{}", listed(known), hint));
}

void Reader::program(Text name, std::string& value, Text meaning) {
  text(name, value, meaning, Need::optional);
  const YamlNode* node = find({name, meaning, "", false});
  if (node && value.find('/') != std::string::npos)
    value = std::filesystem::absolute(named_path(node->place.file->path.parent_path(), value)).string();
}

void Reader::path(Text name, std::filesystem::path& value, Text meaning, Need need) {
  const Field field{name, meaning, "", need == Need::required && value.empty()};
  const YamlNode* node = scalar(field);
  if (!node) return;
  value = named_path(node->place.file->path.parent_path(), node->text);
  if (!std::filesystem::exists(value))
    wrong(field, node->place, node->text, fmt::format("no such file or folder: {}", value.string()));
  else if (!std::filesystem::is_regular_file(value) && !std::filesystem::is_directory(value))
    wrong(field, node->place, node->text, "must be a file or a folder, not a device");
}

void Reader::numbers(Text name, std::vector<double>& values, const ListRule& rule, Text meaning, Need need) {
  const Field field{name, meaning, unit(rule.dimension), need == Need::required && values.empty()};
  const YamlNode* node = find(field);
  if (!node) return;
  if (node->kind != YamlNode::Kind::list)
    return wrong(field, node->place, described(node->kind), "must be a list of numbers");
  const std::size_t given = node->items.size();
  if (given == 0 || (rule.count != 0 && given != rule.count))
    return wrong(field, node->place, fmt::format("{} numbers", given),
                 rule.count == 0 ? "must be at least one" : fmt::format("must be {} numbers", rule.count));
  std::vector<double> read;
  for (const auto& item : node->items) {
    if (item.kind != YamlNode::Kind::scalar) return wrong(field, item.place, described(item.kind), "must be a number");
    if (const auto value = quantity(field, item, rule.dimension, rule.range)) read.push_back(*value);
  }
  if (read.size() == given) values = std::move(read);
}

void Reader::texts(Text name, std::vector<std::string>& values, Text meaning, Need need) {
  const Field field{name, meaning, "", need == Need::required && values.empty()};
  const YamlNode* node = find(field);
  if (!node) return;
  if (node->kind != YamlNode::Kind::list)
    return wrong(field, node->place, described(node->kind), "must be a list of words");
  std::vector<std::string> read;
  for (const auto& item : node->items) {
    if (item.kind != YamlNode::Kind::scalar || item.text.empty())
      return wrong(field, item.place, described(item.kind), "must be a word");
    read.push_back(item.text);
  }
  values = std::move(read);
}

void Reader::check(bool holds, Text field, Text rule) {
  Section& section = sections_.back();
  if (holds || section.failed || broken_condition()) return;
  const YamlNode* node = section.node ? section.node->find(field) : nullptr;
  const std::string value = node && node->kind == YamlNode::Kind::scalar ? node->text : "";
  wrong({field, {}, ""}, node ? node->place : section.place, value, std::string(rule));
}

bool Reader::enter(Text name, Text meaning) {
  const Field field{name, meaning, ""};
  const YamlNode* node = find(field);
  if (broken_condition()) return false;
  if (node && node->kind != YamlNode::Kind::map) {
    wrong(field, node->place, described(node->kind), "must be a section of named fields");
    return false;
  }
  const Section& outer = sections_.back();
  sections_.push_back(
      {node, fmt::format("{}{}.", outer.path, name), node ? node->place : outer.place, std::string(meaning), {}, {}});
  return true;
}

bool Reader::enter_if_given(Text name, Text meaning, bool held) {
  const YamlNode* node = sections_.back().node ? sections_.back().node->find(name) : nullptr;
  if (node || held) return enter(name, meaning);
  find({name, meaning, ""});
  return false;
}

void Reader::leave() {
  const Section section = std::move(sections_.back());
  sections_.pop_back();
  report_unknown(section);
  if (section.failed) sections_.back().failed = true;
}

std::vector<std::string> Reader::entry_names(const std::vector<std::string>&, Need need) {
  Section& section = sections_.back();
  if (section.node)
    for (const auto& entry : section.node->entries) {
      section.known.push_back(entry.key);
      const bool has_dot = entry.key.find('.') != std::string::npos;
      if (is_name(entry.key) && !has_dot) continue;
      section.failed = true;
      problems_.add(entry.place, fmt::format("{}{}: {}", section.path, shortened(entry.key),
                                             is_name(entry.key) ? field_name_rule : name_rule));
    }
  if (section.known.empty() && need == Need::required) {
    section.failed = true;
    problems_.add(section.place,
                  fmt::format("{}: missing: at least one entry must be given{}",
                              section.path.substr(0, section.path.size() - 1), with_meaning(section.meaning)));
  }
  return section.known;
}

bool Reader::begin_when(Text field, const std::string& value, std::span<const Text> words) {
  const bool holds = std::find(words.begin(), words.end(), value) != words.end();
  const YamlNode* section = sections_.back().node;
  const YamlNode* choice = section ? section->find(field) : nullptr;
  const int depth = choice ? choice->place.file->depth : std::numeric_limits<int>::max();
  conditions_.push_back({holds, std::string(field), value, fmt::format("{}", fmt::join(words, " or ")), depth});
  return true;
}

void Reader::end_when() {
  conditions_.pop_back();
}

std::string Reader::only_with(const Condition& condition) {
  return fmt::format("only with '{}: {}'; here {} is '{}'", condition.field, condition.words, condition.field,
                     condition.chosen);
}

/// What belongs to a choice that was not understood, or that a file made which builds on the one where this stands.
bool Reader::is_moot(const Condition& condition, const YamlNode::Entry& entry) {
  return condition.chosen.empty() || condition.depth < entry.place.file->depth;
}

void Reader::report_unknown(const Section& section) {
  if (!section.node) return;
  for (const auto& entry : section.node->entries) {
    if (std::find(section.known.begin(), section.known.end(), entry.key) != section.known.end()) continue;
    const auto elsewhere = section.inapplicable.find(entry.key);
    if (elsewhere != section.inapplicable.end() && is_moot(elsewhere->second, entry)) continue;
    const std::string near = problems_.are_many() ? "" : nearest(entry.key, section.known);
    std::string rule = "unknown field";
    if (elsewhere != section.inapplicable.end())
      rule = only_with(elsewhere->second);
    else if (!near.empty())
      rule += fmt::format("; did you mean '{}'?", near);
    else if (!section.known.empty())
      rule += "; known here: " + listed(section.known);
    problems_.add(entry.place, fmt::format("{}{}: {}", section.path, shortened(entry.key), rule));
  }
}

}  // namespace tether
