#include "common/config/echo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

/// JSON texts, numbers and flags are YAML as well.
std::string scalar_text(const Json& value) {
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

void write_yaml(const Json& section, const std::string& indent, std::string& out) {
  for (const auto& [key, value] : section.items()) {
    out += indent + key + ":";
    if (value.is_object() && !value.empty()) {
      out += "\n";
      write_yaml(value, indent + "  ", out);
    } else if (value.is_array()) {
      std::string items;
      for (const auto& item : value) items += (items.empty() ? "" : ", ") + scalar_text(item);
      out += " [" + items + "]\n";
    } else {
      out += " " + (value.is_object() ? "{}" : scalar_text(value)) + "\n";
    }
  }
}

}  // namespace

struct Echo::Tree {
  struct Open {
    std::string name;
    Json section;
  };
  std::vector<Open> open{{"", Json::object()}};
  Json& section() { return open.back().section; }
};

Echo::Echo() : tree_(std::make_unique<Tree>()) {}
Echo::~Echo() = default;

std::string Echo::json() const {
  return tree_->section().dump(2);
}

std::string Echo::yaml() const {
  std::string out;
  write_yaml(tree_->section(), "", out);
  return out;
}

void Echo::number(Text name, double& value, Dimension, Range, Text) {
  if (std::isfinite(value)) tree_->section()[std::string(name)] = value;
}

void Echo::number(Text name, std::optional<double>& value, Dimension, Range, Text) {
  if (value) tree_->section()[std::string(name)] = *value;
}

void Echo::integer(Text name, int& value, IntegerRange, Text) {
  tree_->section()[std::string(name)] = value;
}

void Echo::flag(Text name, bool& value, Text) {
  tree_->section()[std::string(name)] = value;
}

void Echo::text(Text name, std::string& value, Text, Need) {
  if (!value.empty()) tree_->section()[std::string(name)] = value;
}

void Echo::choice(Text name, std::string& value, std::span<const Word>, Text) {
  tree_->section()[std::string(name)] = value;
}

void Echo::path(Text name, std::filesystem::path& value, Text, Need) {
  if (!value.empty()) tree_->section()[std::string(name)] = std::filesystem::absolute(value).string();
}

void Echo::numbers(Text name, std::vector<double>& values, const ListRule&, Text, Need) {
  if (!values.empty()) tree_->section()[std::string(name)] = values;
}

void Echo::texts(Text name, std::vector<std::string>& values, Text, Need) {
  if (!values.empty()) tree_->section()[std::string(name)] = values;
}

void Echo::check(bool, Text, Text) {}

bool Echo::enter(Text name, Text) {
  tree_->open.push_back({std::string(name), Json::object()});
  return true;
}

bool Echo::enter_if_given(Text name, Text meaning, bool held) {
  return held && enter(name, meaning);
}

void Echo::leave() {
  Tree::Open done = std::move(tree_->open.back());
  tree_->open.pop_back();
  tree_->section()[done.name] = std::move(done.section);
}

std::vector<std::string> Echo::entry_names(const std::vector<std::string>& held, Need) {
  return held;
}

bool Echo::begin_when(Text, const std::string& value, std::span<const Text> words) {
  return std::find(words.begin(), words.end(), value) != words.end();
}

void Echo::end_when() {}

}  // namespace tether
