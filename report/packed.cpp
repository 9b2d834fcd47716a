#include "report/packed.hpp"

#include <cmath>
#include <limits>

#include "common/base/error.hpp"

namespace tether {

std::string base64(const void* bytes, std::size_t count) {
  constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* from = static_cast<const unsigned char*>(bytes);
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3) {
    const std::size_t left = std::min<std::size_t>(3, count - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < left ? from[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? letters[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string packed16(const MatrixXd& numbers, double quantum) {
  std::vector<std::int16_t> all;
  all.reserve(static_cast<std::size_t>(numbers.size()));
  for (const double number : numbers.reshaped()) {
    const double rounded = std::round(number / quantum);
    if (std::abs(rounded) > std::numeric_limits<std::int16_t>::max())
      throw run_error("{} is more than 32767 times {}", number, quantum);
    all.push_back(std::isnan(number) ? std::numeric_limits<std::int16_t>::min() : static_cast<std::int16_t>(rounded));
  }
  return base64(all.data(), 2 * all.size());
}

std::string packed32(const std::vector<std::int32_t>& numbers) {
  return base64(numbers.data(), 4 * numbers.size());
}

}  // namespace tether
