#include "vessel/gmsh_source.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

#include "common/base/error.hpp"

namespace tether {

void GmshSource::fail(const std::string& what) const {
  const auto end = content_.begin() + static_cast<std::ptrdiff_t>(std::min(position_, content_.size()));
  if (binary_) throw input_error("{}: byte {}: {}", name_, position_, what);
  throw input_error("{}:{}: {}", name_, 1 + std::count(content_.begin(), end, '\n'), what);
}

void GmshSource::require(std::size_t bytes) const {
  if (position_ + bytes > content_.size()) fail("the file ends too early");
}

void GmshSource::skip_blanks() {
  while (position_ < content_.size() && std::isspace(static_cast<unsigned char>(content_[position_]))) ++position_;
}

bool GmshSource::at_end() {
  skip_blanks();
  return position_ == content_.size();
}

std::string_view GmshSource::word() {
  skip_blanks();
  require(1);
  const std::size_t start = position_;
  while (position_ < content_.size() && !std::isspace(static_cast<unsigned char>(content_[position_]))) ++position_;
  return std::string_view(content_).substr(start, position_ - start);
}

std::string GmshSource::quoted() {
  const std::size_t open = content_.find('"', position_),
                    close = open == std::string::npos ? open : content_.find('"', open + 1);
  if (close == std::string::npos) fail("a name in quotes was expected");
  position_ = close + 1;
  return content_.substr(open + 1, close - open - 1);
}

double GmshSource::text_number() {
  const std::string text(word());
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size())
    fail(fmt::format("\"{}\" found where a number was expected", text.substr(0, 40)));
  return value;
}

/// Throws InputError for what is no whole number or too large for its kind.
template <class Number>
Number GmshSource::text_as() {
  const std::string_view text = word();
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    fail(fmt::format("\"{}\" found where a whole number was expected", text.substr(0, 40)));
  return value;
}
template std::int32_t GmshSource::text_as();
template std::uint64_t GmshSource::text_as();

std::int64_t GmshSource::text_integer() {
  return text_as<std::int64_t>();
}

std::size_t GmshSource::count() {
  const std::size_t stated = size(), left = content_.size() - position_;
  if (stated > left) fail(fmt::format("{} items are stated, {} bytes are left", stated, left));
  return stated;
}

void GmshSource::end_line() {
  const std::size_t end = content_.find('\n', position_);
  position_ = end == std::string::npos ? content_.size() : end + 1;
}

void GmshSource::skip_to(std::string_view word) {
  const std::size_t found = content_.find(word, position_);
  if (found == std::string::npos) fail(fmt::format("{} is missing", word));
  position_ = found + word.size();
}

void GmshSource::expect(std::string_view expected) {
  if (const std::string_view found = word(); found != expected)
    fail(fmt::format("{} was expected, {} found", expected, found.substr(0, 40)));
}

}  // namespace tether
