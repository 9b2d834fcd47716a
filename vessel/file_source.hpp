#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tether {

/// A kind of number in a file.
enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Bytes of one such number in a binary file.
std::size_t size_of(Scalar);
bool is_integer(Scalar);

/// How a file writes its numbers.
enum class Encoding { text, little_endian, big_endian };

/// Reads words and numbers of a file one after the other, from text or binary, and trusts nothing in it: whatever the
/// file states and has not ends in an InputError with the line, in binary data the byte.
class FileSource {
 public:
  /// Throws InputError if the file cannot be opened.
  explicit FileSource(const std::filesystem::path& path);

  void set_encoding(Encoding encoding) { encoding_ = encoding; }
  Encoding encoding() const { return encoding_; }
  bool text() const { return encoding_ == Encoding::text; }
  const std::string& name() const { return name_; }

  bool at_end();             ///< skips blanks and ends of lines
  std::string_view word();   ///< the next characters without blanks, on this line or a later one
  std::string_view line();   ///< what is left of this line, without its end; goes behind it
  bool at_end_of_line();     ///< skips blanks
  void skip(std::size_t n);  ///< bytes
  std::size_t left() const { return content_.size() - position_; }

  /// A number of things, 0 or more, written as text in files of all encodings.
  std::uint64_t count(std::string_view of_what);

  std::int64_t integer(Scalar type);
  double real(Scalar type);  ///< integers too

  /// Throws InputError unless what is left can hold so many items of so many bytes: to be asked before memory is taken.
  void require(std::uint64_t items, std::uint64_t bytes, std::string_view of_what) const;
  /// The same of numbers, which take two characters each in text.
  void require_numbers(std::uint64_t numbers, Scalar type, std::string_view of_what) const;

  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_expected(std::string_view expected, std::string_view found) const;

 private:
  template <class Number>
  Number raw();

  std::string name_, content_;
  std::size_t position_ = 0;
  std::size_t place_ = 0;  ///< where the last word, line or number begins
  Encoding encoding_ = Encoding::text;
};

}  // namespace tether
