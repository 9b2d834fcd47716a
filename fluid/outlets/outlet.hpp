#pragma once

#include <memory>
#include <span>

#include "common/base/effect.hpp"

namespace tether::fluid {

/// What an outlet knows when a step begins.
struct OutletInput {
  double dt = 0;      ///< [time]
  double stored = 0;  ///< the outlet's stored pressure P at the start of the step
  double curve = 0;   ///< the prescribed pressure's curve at the end of the step; 0 without one
};

/// What lies beyond an opening. Over one implicit step its pressure depends on the flow out through it as
///   p = known + Z Q  (F.9):
/// the fluid solves for both at once, whatever stands behind the two numbers.
class Outlet {
 public:
  virtual ~Outlet() = default;
  /// Z >= 0 [pressure * time / volume]; 0: the pressure is prescribed.
  virtual double impedance(double dt) const = 0;
  /// The pressure at zero flow.
  virtual double known(const OutletInput& input) const = 0;
  /// Whether a pressure is stored from step to step.
  virtual bool stores() const { return false; }
  /// The stored pressure before the first step.
  virtual double initial() const { return 0; }
  /// The stored pressure at the end of the step, with the flow Q of its end.
  virtual double advanced(const OutletInput& input, double /*flow*/) const { return input.stored; }
};

/// All outlets, one line each in registry.cpp.
std::span<const Registered<Outlet>> outlets();

}  // namespace tether::fluid
