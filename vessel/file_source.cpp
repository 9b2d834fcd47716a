#include "vessel/file_source.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "common/base/error.hpp"
#include "vessel/readers.hpp"

namespace tether {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

bool is_space(char c) {
  return is_blank(c) || c == '\n';
}

/// For messages: what was found, without bytes that a terminal would not show.
std::string shown(std::string_view text) {
  std::string shown(text.substr(0, 40));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return shown;
}

template <class Number>
bool parse(std::string_view word, Number& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range && std::is_floating_point_v<Number>)
    value = static_cast<Number>(std::strtod(std::string(word).c_str(), nullptr));  // 1e-400 is 0
  else if (error != std::errc())
    return false;
  return end == word.data() + word.size();
}

}  // namespace

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::int8:
    case Scalar::uint8:
      return 1;
    case Scalar::int16:
    case Scalar::uint16:
      return 2;
    case Scalar::int32:
    case Scalar::uint32:
    case Scalar::float32:
      return 4;
    default:
      return 8;
  }
}

bool is_integer(Scalar type) {
  return type != Scalar::float32 && type != Scalar::float64;
}

FileSource::FileSource(const std::filesystem::path& path) : name_(path.string()), content_(file_content(path)) {}

void FileSource::fail(const std::string& what) const {
  if (!text()) throw input_error("{}: byte {}: {}", name_, place_, what);
  const auto end = content_.begin() + static_cast<std::ptrdiff_t>(place_);
  throw input_error("{}:{}: {}", name_, 1 + std::count(content_.begin(), end, '\n'), what);
}

void FileSource::fail_expected(std::string_view expected, std::string_view found) const {
  if (found.empty()) fail(fmt::format("the file or the line ends where {} was expected: cut short?", expected));
  fail(fmt::format("\"{}\" found where {} was expected", shown(found), expected));
}

bool FileSource::at_end() {
  while (position_ < content_.size() && is_space(content_[position_])) ++position_;
  return position_ == content_.size();
}

bool FileSource::at_end_of_line() {
  while (position_ < content_.size() && is_blank(content_[position_])) ++position_;
  return position_ == content_.size() || content_[position_] == '\n';
}

std::string_view FileSource::word() {
  at_end();
  place_ = position_;
  while (position_ < content_.size() && !is_space(content_[position_])) ++position_;
  return std::string_view(content_).substr(place_, position_ - place_);
}

std::string_view FileSource::line() {
  place_ = position_;
  const std::size_t end = std::min(content_.find('\n', position_), content_.size());
  position_ = std::min(end + 1, content_.size());
  std::string_view line = std::string_view(content_).substr(place_, end - place_);
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

void FileSource::skip(std::size_t n) {
  require(n, 1, "bytes");
  position_ += n;
}

std::uint64_t FileSource::count(std::string_view of_what) {
  const std::string_view found = word();
  std::uint64_t value = 0;
  if (!parse(found, value)) fail_expected(fmt::format("the number of {}", of_what), found);
  return value;
}

void FileSource::require(std::uint64_t items, std::uint64_t bytes, std::string_view of_what) const {
  if (bytes > 0 && items > left() / bytes)
    fail(fmt::format("{} {} are stated, {} bytes are left in the file: cut short?", items, of_what, left()));
}

void FileSource::require_numbers(std::uint64_t numbers, Scalar type, std::string_view of_what) const {
  if (!text()) return require(numbers, size_of(type), of_what);
  if (numbers > 0) require(numbers - 1, 2, of_what);  // the last one may end the file
}

template <class Number>
Number FileSource::raw() {
  place_ = position_;
  require(1, sizeof(Number), "numbers");
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), content_.data() + position_, sizeof(Number));
  position_ += sizeof(Number);
  if ((encoding_ == Encoding::big_endian) != (std::endian::native == std::endian::big))
    std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Number>(bytes);
}

std::int64_t FileSource::integer(Scalar type) {
  if (text()) {
    std::int64_t value = 0;
    if (const std::string_view found = word(); !parse(found, value)) fail_expected("an integer", found);
    return value;
  }
  switch (type) {
    case Scalar::int8:
      return raw<std::int8_t>();
    case Scalar::uint8:
      return raw<std::uint8_t>();
    case Scalar::int16:
      return raw<std::int16_t>();
    case Scalar::uint16:
      return raw<std::uint16_t>();
    case Scalar::int32:
      return raw<std::int32_t>();
    case Scalar::uint32:
      return raw<std::uint32_t>();
    default:
      return raw<std::int64_t>();
  }
}

double FileSource::real(Scalar type) {
  if (text()) {
    double value = 0;
    if (const std::string_view found = word(); !parse(found, value)) fail_expected("a number", found);
    return value;
  }
  if (type == Scalar::float32) return raw<float>();
  if (type == Scalar::float64) return raw<double>();
  if (type == Scalar::uint64) return static_cast<double>(raw<std::uint64_t>());
  return static_cast<double>(integer(type));
}

}  // namespace tether
