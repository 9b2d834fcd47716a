#pragma once

#include <cmath>
#include <numbers>

#include "fluid/windkessels/periodic_beat.hpp"

namespace tether::testing {

/// A beat of 0.8 s: systole for 0.3 s, with a mean of 80 ml/s.
inline PeriodicFlow beat_of_a_heart() {
  constexpr double period = 0.8, systole = 0.3, peak = 80 * period / systole * std::numbers::pi / 2;
  constexpr int rows = 160;
  PeriodicFlow flow;
  for (int i = 0; i <= rows; ++i) {
    const double time = period * i / rows;
    flow.times.push_back(time);
    flow.values.push_back(time < systole ? peak * std::sin(std::numbers::pi * time / systole) : 0.0);
  }
  return flow;
}

}  // namespace tether::testing
