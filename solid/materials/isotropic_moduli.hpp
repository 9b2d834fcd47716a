#pragma once

#include <cmath>
#include <span>

#include "common/base/effect.hpp"
#include "solid/materials/material.hpp"

namespace tether {

/// Small-strain moduli by which the laws with two constants are entered.
struct IsotropicModuli {
  double shear, bulk;  ///< mu = E/(2 (1 + nu)), kappa = E/(3 (1 - 2 nu)) [pressure]
  static IsotropicModuli from(std::span<const double> young_and_poisson) {
    const double young = young_and_poisson[0], poisson = young_and_poisson[1];
    return {young / (2 * (1 + poisson)), young / (3 * (1 - 2 * poisson))};
  }
};

inline Parameter young_parameter() {
  return {.name = "young",
          .meaning = "Young's modulus at small strain",
          .dimension = dimension::pressure,
          .range = range::positive,
          .standard = undefined,
          .absent = undefined,
          .transform = Transform::log2,
          .prior_deviation = 1.0};
}
inline Parameter poisson_parameter() {
  return {.name = "poisson",
          .meaning = "Poisson's ratio at small strain; 0.5 would be incompressible",
          .dimension = dimension::none,
          .range = {0.0, 0.4999},
          .standard = 0.45,
          .absent = undefined,
          .transform = Transform::bounded,
          .prior_deviation = 0.5};
}
inline Parameter modulus_parameter(const char* name, const char* meaning, Range range = range::not_negative) {
  return {.name = name,
          .meaning = meaning,
          .dimension = dimension::pressure,
          .range = range,
          .standard = undefined,
          .absent = undefined,
          .transform = Transform::log2,
          .prior_deviation = 1.0};
}

/// W += kappa/4 (J^2 - 1 - 2 ln J): no stress at J = 1, bulk modulus kappa, infinite at J = 0.
inline void add_volumetric(Potential& w, double bulk, double j) {
  w.energy += 0.25 * bulk * (j * j - 1 - 2 * std::log(j));
  w.first[2] += 0.5 * bulk * (j - 1 / j);
  w.second(2, 2) += 0.5 * bulk * (1 + 1 / (j * j));
}

/// W += c (I J^-m - 3) for the invariant number `which` (0: I1 with m = 2/3, 1: I2 with m = 4/3).
inline void add_isochoric(Potential& w, double c, int which, double invariant, double j) {
  const double m = which == 0 ? 2.0 / 3.0 : 4.0 / 3.0, cubic_root = std::cbrt(j),
               root_squared = cubic_root * cubic_root;
  const double scale = c / (which == 0 ? root_squared : root_squared * root_squared);
  w.energy += scale * invariant - 3 * c;
  w.first[which] += scale;
  w.first[2] += -m * scale * invariant / j;
  w.second(which, 2) += -m * scale / j;
  w.second(2, which) += -m * scale / j;
  w.second(2, 2) += m * (m + 1) * scale * invariant / (j * j);
}

}  // namespace tether
