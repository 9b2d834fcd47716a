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

/// kappa/4 (J^2 - 1 - 2 ln J): no stress at J = 1, bulk modulus kappa, infinite at J = 0.
inline double volumetric_energy(double bulk, double j) {
  return 0.25 * bulk * (j * j - 1 - 2 * std::log(j));
}
template <class T>
void add_volumetric(Derivatives<T>& w, double bulk, const T& j) {
  const T inverse = 1.0 / j;
  w.first[2] += 0.5 * bulk * (j - inverse);
  w.second(2, 2) += 0.5 * bulk * (1.0 + inverse * inverse);
}

/// An isochoric term c (I J^-m - 3), of the invariant number `which` (0: I1 with m = 2/3, 1: I2 with m = 4/3).
inline double isochoric_energy(double c, int which, double invariant, double j) {
  const double root = std::cbrt(j), squared = root * root;
  return c * (invariant / (which == 0 ? squared : squared * squared) - 3);
}
template <class T>
void add_isochoric(Derivatives<T>& w, double c, int which, const T& invariant, const T& j) {
  const double m = which == 0 ? 2.0 / 3.0 : 4.0 / 3.0;
  const T root = inverse_cube_root(j), squared = root * root, inverse = root * squared;
  const T scale = c * (which == 0 ? squared : squared * squared);
  w.first[which] += scale;
  w.first[2] += -m * scale * invariant * inverse;
  w.second(which, 2) += -m * scale * inverse;
  w.second(2, which) += -m * scale * inverse;
  w.second(2, 2) += m * (m + 1) * scale * invariant * inverse * inverse;
}

}  // namespace tether
