#include "common/base/name.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace tether {
namespace {

constexpr std::size_t longest_name = 100;
constexpr std::size_t longest_file_name = 200;  // file systems take 255 bytes, and more is added to it

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

bool may_stand_in_a_name(char c) {
  constexpr std::string_view signs = " _-.+=()%";
  return !is_ascii(c) || std::isalnum(static_cast<unsigned char>(c)) != 0 || signs.find(c) != std::string_view::npos;
}

/// Characters that begin alike: the bits that say so, how many bytes follow, the smallest that needs so many.
struct Lead {
  unsigned char mask, bits;
  std::size_t followers;
  char32_t smallest;
};

constexpr std::array leads{Lead{0x80, 0x00, 0, 0x0}, Lead{0xE0, 0xC0, 1, 0x80}, Lead{0xF0, 0xE0, 2, 0x800},
                           Lead{0xF8, 0xF0, 3, 0x10000}};

struct Character {
  std::size_t bytes = 0;
  char32_t code = 0;
  bool is_separator() const { return (code >= 0x80 && code < 0xA0) || code == 0x2028 || code == 0x2029; }
};

/// The character that a text begins with; no bytes if it begins with none.
Character first_character(std::string_view text) {
  const auto byte = static_cast<unsigned char>(text.front());
  const auto* lead = std::find_if(leads.begin(), leads.end(), [&](const Lead& l) { return (byte & l.mask) == l.bits; });
  if (lead == leads.end() || text.size() <= lead->followers) return {};
  char32_t code = byte & static_cast<unsigned char>(~lead->mask);
  for (std::size_t i = 1; i <= lead->followers; ++i) {
    const auto follower = static_cast<unsigned char>(text[i]);
    if ((follower & 0xC0) != 0x80) return {};
    code = (code << 6) | (follower & 0x3F);
  }
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < lead->smallest || is_surrogate || code > 0x10FFFF) return {};
  return {lead->followers + 1, code};
}

}  // namespace

int first_line_not_utf8(std::string_view text) {
  for (int line = 1; !text.empty();) {
    const std::size_t bytes = first_character(text).bytes;
    if (bytes == 0) return line;
    if (text.front() == '\n') ++line;
    text.remove_prefix(bytes);
  }
  return 0;
}

bool is_utf8(std::string_view text) {
  return first_line_not_utf8(text) == 0;
}

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > longest_name || text.front() == ' ' || text.back() == ' ' || !is_utf8(text) ||
      text.find_first_not_of('.') == std::string_view::npos ||
      !std::all_of(text.begin(), text.end(), may_stand_in_a_name))
    return false;
  while (!text.empty()) {
    const Character first = first_character(text);
    if (first.is_separator()) return false;
    text.remove_prefix(first.bytes);
  }
  return true;
}

bool is_file_name(std::string_view text) {
  if (text.empty() || text.size() > longest_file_name || text.front() == '.') return false;
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; });
}

}  // namespace tether
