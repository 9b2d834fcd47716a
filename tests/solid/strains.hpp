#pragma once

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "common/base/effect.hpp"
#include "solid/materials/material.hpp"
#include "tests/solid/differences.hpp"

/// Strains, rotations and material constants for tests.
namespace tether {

inline Voigt to_voigt(const Mat3& strain) {
  Voigt v;
  v << strain(0, 0), strain(1, 1), strain(2, 2), 2 * strain(0, 1), 2 * strain(1, 2), 2 * strain(0, 2);
  return v;
}

/// Six numbers 11 22 33 12 23 13 as a symmetric tensor (a stress; a strain after halving the last three).
inline Mat3 to_tensor(const Voigt& v) {
  Mat3 tensor;
  tensor << v[0], v[3], v[5], v[3], v[1], v[4], v[5], v[4], v[2];
  return tensor;
}

inline Voigt green_lagrange(const Mat3& deformation_gradient) {
  return to_voigt(0.5 * (deformation_gradient.transpose() * deformation_gradient - Mat3::Identity()));
}

/// 1 plus random entries of the given size.
inline Mat3 random_gradient(Random& random, double size) {
  return Mat3::Identity() + size * random.matrix(3, 3);
}

inline Mat3 random_rotation(Random& random) {
  return Eigen::AngleAxisd(3.0 * random(), Vec3(random.matrix(3, 1)).normalized()).toRotationMatrix();
}

/// A value for every parameter of a law: its standard, or numbers of order one that all differ.
inline std::vector<double> values_of_order_one(const EffectDeclaration& declaration) {
  std::vector<double> values;
  for (const Parameter& parameter : declaration.parameters)
    values.push_back(std::isfinite(parameter.standard) ? parameter.standard : 1.0 + 0.7 * double(values.size()));
  return values;
}

}  // namespace tether
