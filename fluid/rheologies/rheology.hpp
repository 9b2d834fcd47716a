#pragma once

#include <memory>
#include <span>

#include "common/base/effect.hpp"

namespace tether::fluid {

/// How blood resists shearing: a generalised Newtonian fluid, stress 2 mu(gamma) eps(v).
class Rheology {
 public:
  virtual ~Rheology() = default;
  /// mu [pressure * time] at the shear rate gamma = sqrt(2 eps:eps) >= 0 [1/time]; positive and finite, also at 0.
  /// (F.14)
  virtual double viscosity(double shear_rate) const = 0;
  /// Whether the viscosity is one number everywhere: spares the terms that come from its gradient.
  virtual bool is_constant() const { return false; }
};

/// All rheologies, one line each in registry.cpp.
std::span<const Registered<Rheology>> rheologies();

}  // namespace tether::fluid
