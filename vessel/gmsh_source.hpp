#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace tether {

/// Reads the numbers of a .msh file one after the other, from text or binary alike.
class GmshSource {
 public:
  GmshSource(std::string name, std::string content) : name_(std::move(name)), content_(std::move(content)) {}

  void set_binary(bool binary) { binary_ = binary; }
  bool binary() const { return binary_; }
  bool at_end();

  std::string_view word();  ///< next characters without blanks; text, also in a binary file
  std::string quoted();     ///< "a name"
  double text_number();     ///< a number written as text in both kinds of file
  std::int64_t text_integer();
  void end_line();  ///< goes behind the next end of line
  void skip_to(std::string_view word);
  /// Throws InputError unless the next word is `word`.
  void expect(std::string_view word);

  int integer() { return binary_ ? raw<std::int32_t>() : text_as<std::int32_t>(); }
  std::size_t size() { return binary_ ? raw<std::uint64_t>() : text_as<std::uint64_t>(); }
  /// A number of things that follow, which cannot be more than the bytes that are left.
  std::size_t count();
  double real() { return binary_ ? raw<double>() : text_number(); }

  /// Throws InputError with the file's name and, in text, the line.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class Number>
  Number raw() {
    require(sizeof(Number));
    Number value;
    std::memcpy(&value, content_.data() + position_, sizeof(Number));
    position_ += sizeof(Number);
    return value;
  }
  template <class Number>
  Number text_as();
  void require(std::size_t bytes) const;
  void skip_blanks();

  std::string name_, content_;
  std::size_t position_ = 0;
  bool binary_ = false;
};

}  // namespace tether
