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
};

struct CodeRange {
  char32_t first, last;
};

/// Controls, but \n and \t; separators of lines, marks of direction, and what has no width.
constexpr std::array unseen{CodeRange{0x00, 0x08},     CodeRange{0x0B, 0x1F},     CodeRange{0x7F, 0x9F},
                            CodeRange{0x200B, 0x200F}, CodeRange{0x2028, 0x202E}, CodeRange{0x2060, 0x2069},
                            CodeRange{0xFEFF, 0xFEFF}};

/// Whether a text begins with it.
bool is_seen(const Character& c) {
  return c.bytes > 0 && std::none_of(unseen.begin(), unseen.end(),
                                     [&](const CodeRange& r) { return c.code >= r.first && c.code <= r.last; });
}

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
  return !text.empty() && text.size() <= longest_name && text.front() != ' ' && text.back() != ' ' &&
         text.find_first_not_of('.') != std::string_view::npos &&
         std::all_of(text.begin(), text.end(), may_stand_in_a_name) && is_printable(text);
}

bool is_file_name(std::string_view text) {
  if (text.empty() || text.size() > longest_file_name || text.front() == '.') return false;
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; });
}

bool is_printable(std::string_view text) {
  while (!text.empty()) {
    const Character first = first_character(text);
    if (!is_seen(first)) return false;
    text.remove_prefix(first.bytes);
  }
  return true;
}

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const Character first = first_character(text);
    const std::size_t bytes = std::max<std::size_t>(first.bytes, 1);
    shown += is_seen(first) ? text.substr(0, bytes) : "?";
    text.remove_prefix(bytes);
  }
  return shown;
}

}  // namespace tether
