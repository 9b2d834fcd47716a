#include "vessel/xml_bytes.hpp"

#include <array>

namespace tether {
namespace {

std::array<int, 256> digits_of_base64() {
  static constexpr std::string_view in_order = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> digits;
  digits.fill(-1);
  for (std::size_t i = 0; i < in_order.size(); ++i)
    digits[static_cast<unsigned char>(in_order[i])] = static_cast<int>(i);
  return digits;
}

int digit_of_base64(char c) {
  static const std::array<int, 256> digits = digits_of_base64();
  return digits[static_cast<unsigned char>(c)];
}

}  // namespace

/// Ends before four characters that are no group of base 64, as VTK does, and behind one that is filled up with =.
std::string XmlBytes::decode(std::uint64_t bytes) const {
  std::string decoded;
  for (std::string_view groups = text_.substr(0, characters(bytes)); groups.size() >= 4; groups.remove_prefix(4)) {
    const std::string_view group = groups.substr(0, 4);
    const std::size_t digits = std::min<std::size_t>(group.find('='), 4);
    std::uint32_t bits = 0;
    bool is_group = digits > 1 && group.find_first_not_of('=', digits) == std::string_view::npos;
    for (std::size_t i = 0; i < 4; ++i) {
      const int digit = i < digits ? digit_of_base64(group[i]) : 0;
      is_group = is_group && digit >= 0;
      bits = bits << 6 | static_cast<std::uint32_t>(digit);
    }
    if (!is_group) break;
    for (std::size_t i = 0; i + 1 < digits; ++i) decoded += static_cast<char>(bits >> (16 - 8 * i) & 0xff);
    if (digits < 4) break;
  }
  return decoded.substr(0, bytes);
}

}  // namespace tether
