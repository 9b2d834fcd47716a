#pragma once

#include "common/config/curve_case.hpp"
#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// The field `quantity`, and the dimension that follows from it.
void declare_quantity(Fields& f, std::string& quantity, Dimension& dimension);

/// A measured pressure or flow.
struct TraceCase {
  std::string observable, quantity;
  CurveCase curve = CurveCase(Dimension{});
  double time_shift = 0;
  bool absolute = true, held_out = false;
  CorrectionCase correction{fallible::instrument};
  NoiseCase noise;
  void declare(Fields& f);
  StatedErrors stated_errors() const { return {&correction, time_shift, {}}; }
};

}  // namespace tether
