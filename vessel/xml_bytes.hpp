#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace tether {

/// Bytes at one place of the file: as they are, or in base 64.
class XmlBytes {
 public:
  XmlBytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// No more than so many can follow.
  std::uint64_t left() const { return base64_ ? text_.size() / 4 * 3 : text_.size(); }
  /// The first ones, as many as are there.
  std::string read(std::uint64_t bytes) const { return base64_ ? decode(bytes) : std::string(text_.substr(0, bytes)); }
  /// How many there are, if less than so many.
  std::uint64_t count(std::uint64_t bytes) const {
    return base64_ ? decode(bytes).size() : std::min<std::uint64_t>(bytes, text_.size());
  }
  /// Goes behind so many, and to the next whole group of characters.
  void skip(std::uint64_t bytes) { text_.remove_prefix(std::min(base64_ ? characters(bytes) : bytes, text_.size())); }

 private:
  static std::uint64_t characters(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

  std::string decode(std::uint64_t bytes) const;

  std::string_view text_;
  bool base64_;
};

}  // namespace tether
