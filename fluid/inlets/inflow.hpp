#pragma once

#include <memory>
#include <span>

#include "common/base/effect.hpp"

namespace tether::fluid {

/// What an inlet makes of its curve: Q(t) = gain curve(curve_time(t)) + added(t), into the vessel [volume/time]. (F.12)
class Inflow {
 public:
  virtual ~Inflow() = default;
  virtual double gain() const = 0;
  virtual double curve_time(double time) const = 0;
  /// What the curve lacks, of the period of the curve; 0 where there is none. (F.16)
  virtual double added(double time, double period) const = 0;
};

/// All kinds of inflow, one line each in registry.cpp.
std::span<const Registered<Inflow>> inflows();

}  // namespace tether::fluid
