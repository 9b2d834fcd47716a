#include "common/base/shortened.hpp"

namespace tether {

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto follows = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; };
  std::size_t begin = most / 2, end = text.size() - most / 2;
  while (begin > 0 && follows(begin)) --begin;
  while (end < text.size() && follows(end)) ++end;
  return std::string(text.substr(0, begin)) + " ... " + std::string(text.substr(end));
}

}  // namespace tether
