#include "common/base/transform.hpp"

#include <cmath>

#include "common/base/error.hpp"
#include "common/base/parameter_table.hpp"

namespace tether {
namespace {

double positive(double value) {
  if (!(value > 0)) throw input_error("{} has no logarithm", value);
  return value;
}

double logit(double value, const Range& range) {
  if (!(value > range.lower && value < range.upper))
    throw input_error("{} is not between the bounds {} and {}", value, range.lower, range.upper);
  return std::log((value - range.lower) / (range.upper - value));
}

}  // namespace

double stretched(Transform transform, double value, const Range& range) {
  switch (transform) {
    case Transform::log:
      return std::log(positive(value));
    case Transform::log2:
      return std::log2(positive(value));
    case Transform::bounded:
      return logit(value, range);
    case Transform::linear:
      break;
  }
  return value;
}

double unstretched(Transform transform, double theta, const Range& range) {
  switch (transform) {
    case Transform::log:
      return std::exp(theta);
    case Transform::log2:
      return std::exp2(theta);
    case Transform::bounded:
      return range.lower + (range.upper - range.lower) / (1 + std::exp(-theta));
    case Transform::linear:
      break;
  }
  return theta;
}

Transform transform_named(const std::string& name) {
  for (const Transform t : {Transform::linear, Transform::log, Transform::log2, Transform::bounded})
    if (name_of(t) == name) return t;
  throw input_error("there is no transform \"{}\"; known are: linear, log, log2, bounded", name);
}

}  // namespace tether
