#include "vessel/image/text_header.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "common/base/error.hpp"

namespace tether {

namespace {

/// ITK and teem look for each line among the others, and keep some kB of it. 3D Slicer writes ten lines a segment.
constexpr int most_lines = 10'000;
constexpr std::size_t largest_header = 10'000'000;  ///< bytes

}  // namespace

bool is_length(double number) {
  const double size = std::abs(number);
  return size < 1e9 && (size == 0 || size > 1e-30);
}

std::optional<std::vector<double>> lengths_of(std::string text, bool may_be_nan) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '(' || c == ')'; }, ' ');
  std::vector<double> all;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const char* begin = word.data() + (word.starts_with('+') ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), all.emplace_back());
    const bool is_number = error == std::errc{} && end == word.data() + word.size();
    if (!is_number || !(is_length(all.back()) || (may_be_nan && std::isnan(all.back())))) return std::nullopt;
  }
  return all;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::optional<std::string> TextHeader::next() {
  std::string line;
  if (!std::getline(in_, line)) return std::nullopt;
  ++line_;
  bytes_ += line.size();
  if (line_ > most_lines) fail(fmt::format("the header has more than {} lines", most_lines));
  if (bytes_ > largest_header) fail(fmt::format("the header has more than {} MB", largest_header / 1'000'000));
  const auto is_control = [](char c) { return c != '\t' && c != '\r' && c >= 0 && c < ' '; };
  if (line.size() > longest_line_ || std::any_of(line.begin(), line.end(), is_control))
    fail(fmt::format("a line of text was expected, of no more than {} characters", longest_line_));
  return line;
}

void TextHeader::add(const std::string& name, const std::string& value) {
  if (!fields_.emplace(name, value).second) fail(name + " is given twice");
}

std::string TextHeader::get(const std::string& name) const {
  const auto found = fields_.find(name);
  return found == fields_.end() ? "" : found->second;
}

std::uint64_t TextHeader::count(const std::string& name, std::uint64_t least, std::uint64_t most) const {
  const std::vector<std::uint64_t> one = counts(name, least, most);
  if (one.size() != 1) refuse(name, "must be one number");
  return one.front();
}

std::vector<std::uint64_t> TextHeader::counts(const std::string& name, std::uint64_t least, std::uint64_t most) const {
  std::vector<std::uint64_t> all;
  std::istringstream words(get(name));
  for (std::string word; words >> word;) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), all.emplace_back());
    if (error != std::errc{} || end != word.data() + word.size() || all.back() < least || all.back() > most)
      refuse(name, fmt::format("must be from {} to {}", least, most));
  }
  return all;
}

std::vector<double> TextHeader::lengths(const std::string& name, bool may_be_nan) const {
  auto all = lengths_of(get(name), may_be_nan);
  if (!all) refuse(name, "must be finite numbers, of a size that images have");
  return std::move(*all);
}

std::uint64_t TextHeader::end() {
  return in_.eof() ? std::filesystem::file_size(file_) : static_cast<std::uint64_t>(in_.tellg());
}

void TextHeader::fail(const std::string& what) const {
  throw input_error("{}:{}: {}", file_, line_, what);
}

void TextHeader::refuse(const std::string& name, const std::string& rule) const {
  throw input_error("{}: {}: '{}': {}", file_, name, get(name).substr(0, 80), rule);
}

}  // namespace tether
