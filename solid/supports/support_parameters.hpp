#pragma once

#include "common/base/effect.hpp"

namespace tether {

/// scale: of soft tissue; of what is hard, more [Pa/m].
inline Parameter stiffness_parameter(const char* meaning, double scale = 1e6) {
  return {.name = "stiffness",
          .meaning = meaning,
          .dimension = dimension::support_stiffness,
          .range = range::not_negative,
          .standard = 0.0,
          .absent = 0.0,
          .transform = Transform::log2,
          .prior_deviation = 1.0,
          .scale = scale};
}

/// scale: pushes as hard as a spring of soft tissue that goes to and fro once a second [Pa s/m].
inline Parameter damping_parameter(const char* meaning) {
  return {.name = "damping",
          .meaning = meaning,
          .dimension = dimension::support_damping,
          .range = range::not_negative,
          .standard = 0.0,
          .absent = 0.0,
          .transform = Transform::log2,
          .prior_deviation = 1.0,
          .scale = 1e5};
}

}  // namespace tether
