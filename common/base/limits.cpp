#include "common/base/limits.hpp"

#include <cmath>
#include <cstdlib>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// NaN if it is not a number above zero, as is one that is not set.
double seconds_in(const char* text) {
  char* end = nullptr;
  const double seconds = text == nullptr ? 0 : std::strtod(text, &end);
  return seconds > 0 && *end == '\0' ? seconds : std::nan("");
}

double seconds_from(const char* variable, double otherwise) {
  const double seconds = seconds_in(std::getenv(variable));
  return std::isnan(seconds) ? otherwise : seconds;
}

}  // namespace

void check_limits() {
  for (const char* variable : {"TETHER_START_LIMIT", "TETHER_SETUP_LIMIT", "TETHER_END_LIMIT", "TETHER_STOPPED_LIMIT"})
    if (const char* text = std::getenv(variable); text != nullptr && *text != '\0' && std::isnan(seconds_in(text)))
      throw input_error("{}: '{}' is not a number of seconds above zero", variable, text);
}

double start_limit() {
  return seconds_from("TETHER_START_LIMIT", 60);
}

double setup_limit() {
  return seconds_from("TETHER_SETUP_LIMIT", 600);
}

double end_limit() {
  return seconds_from("TETHER_END_LIMIT", 120);
}

double stopped_limit() {
  return seconds_from("TETHER_STOPPED_LIMIT", 60);
}

}  // namespace tether
