#pragma once

#include <string>

#include "common/base/units.hpp"
#include "fsi_master/statistics.hpp"

namespace tether {

/// What a person wants to know of a step.
struct StepNews {
  double time;
  int evaluations;
  MinMax pressure;      ///< of this step
  double displacement;  ///< largest of the interface
};

/// "t 0.12 s  coupling 2  pressure 70.1 .. 95.2 mmHg  moved 1.2 mm"
std::string text_of(const StepNews& news, const UnitSystem& units);

}  // namespace tether
