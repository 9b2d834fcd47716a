#include "common/base/limits.hpp"

#include <cstdlib>

namespace tether {

namespace {

double seconds_from(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  const double seconds = text ? std::atof(text) : 0;
  return seconds > 0 ? seconds : otherwise;
}

}  // namespace

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
