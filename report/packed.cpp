#include "report/packed.hpp"

#include <cmath>
#include <limits>

#include "common/base/base64.hpp"
#include "common/base/error.hpp"

namespace tether {

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
