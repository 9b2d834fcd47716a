#include "common/base/error.hpp"

#include "common/base/name.hpp"

namespace tether {

InputError::InputError(const std::string& message) : std::runtime_error(printable(message)) {}

RunError::RunError(const std::string& message) : std::runtime_error(printable(message)) {}

void assertion_failed(const char* condition, const char* file, int line, const std::string& values) {
  throw InternalError(fmt::format("{}:{}: {} does not hold: {}", file, line, condition, values));
}

}  // namespace tether
