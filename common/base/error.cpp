#include "common/base/error.hpp"

namespace tether {

void assertion_failed(const char* condition, const char* file, int line, const std::string& values) {
  throw InternalError(fmt::format("{}:{}: {} does not hold: {}", file, line, condition, values));
}

}  // namespace tether
