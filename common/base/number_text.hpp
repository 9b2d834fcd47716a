#pragma once

#include <charconv>
#include <optional>
#include <string>

namespace tether {

/// Of an option: nothing if it is no number, or not from the first character to the last.
template <class Number>
std::optional<Number> number_in(const std::string& text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || last != end) return std::nullopt;
  return number;
}

}  // namespace tether
