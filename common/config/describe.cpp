#include "common/config/describe.hpp"

#include <fmt/ranges.h>

#include <cmath>

#include "common/config/rules.hpp"

namespace tether {
namespace {

constexpr const char* must_be_given = "must be given";
constexpr const char* may_be_absent = "may be absent";

std::string standard_of(const std::string& value, Need need) {
  if (!value.empty()) return "default " + value;
  return need == Need::required ? must_be_given : may_be_absent;
}

std::string in_table(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

}  // namespace

std::string Describe::unit(Dimension dimension) const {
  return dimension == dimension::none ? "" : units_.symbol(dimension);
}

void Describe::add(Text name, Line line, Text meaning) {
  line.path = path_ + std::string(name);
  line.meaning = meaning;
  line.condition = fmt::format("{}", fmt::join(conditions_, ", "));
  lines_.push_back(std::move(line));
}

void Describe::number(Text name, double& value, Dimension dimension, Range range, Text meaning) {
  const std::string standard = std::isnan(value) ? must_be_given : fmt::format("default {}", value);
  add(name, {"", "number", unit(dimension), standard, rule_of(range), "", {}, ""}, meaning);
}

void Describe::number(Text name, std::optional<double>& value, Dimension dimension, Range range, Text meaning) {
  const std::string standard = value ? fmt::format("default {}", *value) : may_be_absent;
  add(name, {"", "number", unit(dimension), standard, rule_of(range), "", {}, ""}, meaning);
}

void Describe::integer(Text name, int& value, IntegerRange range, Text meaning) {
  const std::string rule = rule_of(as_range(range));
  add(name, {"", "whole number", "", fmt::format("default {}", value), rule, "", {}, ""}, meaning);
}

void Describe::flag(Text name, bool& value, Text meaning) {
  add(name, {"", "true or false", "", fmt::format("default {}", value), "", "", {}, ""}, meaning);
}

void Describe::text(Text name, std::string& value, Text meaning, Need need) {
  add(name, {"", "text", "", standard_of(value, need), "", "", {}, ""}, meaning);
}

void Describe::choice(Text name, std::string& value, std::span<const Word> words, Text meaning) {
  Line line{"", "choice", "", standard_of(value, Need::required), "", "", {}, ""};
  for (const auto& word : words) line.words.push_back(fmt::format("{}: {}", word.word, word.meaning));
  add(name, std::move(line), meaning);
}

void Describe::path(Text name, std::filesystem::path& value, Text meaning, Need need) {
  add(name, {"", "file", "", standard_of(value.string(), need), "", "", {}, ""}, meaning);
}

void Describe::numbers(Text name, std::vector<double>& values, const ListRule& rule, Text meaning, Need need) {
  const std::string kind = rule.count == 0 ? "list of numbers" : fmt::format("list of {} numbers", rule.count);
  const std::string held = values.empty() ? "" : fmt::format("{}", values);
  add(name, {"", kind, unit(rule.dimension), standard_of(held, need), rule_of(rule.range), "", {}, ""}, meaning);
}

void Describe::texts(Text name, std::vector<std::string>& values, Text meaning, Need need) {
  const std::string held = values.empty() ? "" : fmt::format("[{}]", fmt::join(values, ", "));
  add(name, {"", "list of words", "", standard_of(held, need), "", "", {}, ""}, meaning);
}

void Describe::check(bool, Text, Text) {}

void Describe::go_into(Text name) {
  path_ += std::string(name) + ".";
  outer_conditions_.push_back(std::move(conditions_));
  conditions_.clear();
}

bool Describe::enter(Text name, Text meaning) {
  if (!meaning.empty()) add(name, {"", "section", "", "", "", "", {}, ""}, meaning);
  go_into(name);
  return true;
}

bool Describe::enter_if_given(Text name, Text meaning, bool) {
  add(name, {"", "section", "", may_be_absent, "", "", {}, ""}, meaning);
  go_into(name);
  return true;
}

void Describe::leave() {
  conditions_ = std::move(outer_conditions_.back());
  outer_conditions_.pop_back();
  path_.pop_back();
  path_.erase(path_.rfind('.') + 1);
}

std::vector<std::string> Describe::entry_names(const std::vector<std::string>&, Need) {
  return {"NAME"};
}

bool Describe::begin_when(Text field, const std::string&, std::span<const Text> words) {
  conditions_.push_back(fmt::format("with {}: {}", field, fmt::join(words, " or ")));
  return true;
}

void Describe::end_when() {
  conditions_.pop_back();
}

std::string Describe::text() const {
  std::string out;
  for (const auto& line : lines_) {
    out += line.path;
    if (!line.unit.empty()) out += " [" + line.unit + "]";
    out += "  (" + line.kind;
    for (const auto* fact : {&line.standard, &line.rule, &line.condition})
      if (!fact->empty()) out += "; " + *fact;
    out += ")\n    " + line.meaning + "\n";
    for (const auto& word : line.words) out += "      " + word + "\n";
  }
  return out;
}

/// The heading that a field stands under: its top-level section.
std::string Describe::heading(const Line& line) {
  const auto dot = line.path.find('.');
  return dot == std::string::npos && line.kind != "section" ? "top level" : line.path.substr(0, dot);
}

std::string Describe::markdown() const {
  std::string out, section;
  for (const auto& line : lines_) {
    if (heading(line) != section) {
      section = heading(line);
      out += fmt::format(
          "\n## {}\n\n| field | kind | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n", section);
    }
    std::string meaning = line.meaning;
    if (!line.condition.empty()) meaning += fmt::format(" (`{}`)", line.condition);
    for (const auto& word : line.words)
      meaning += "<br>`" + word.substr(0, word.find(':')) + "`" + word.substr(word.find(':'));
    out += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", line.path, line.kind, line.unit, line.standard, line.rule,
                       in_table(meaning));
  }
  return out;
}

}  // namespace tether
