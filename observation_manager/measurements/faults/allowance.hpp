#pragma once

#include "common/config/fields.hpp"

namespace tether {

/// What data may be off at all times without that being news: standard deviations. Absent: shares of the noise's.
struct LastingAllowance {
  std::optional<double> model, bias, displacement;  ///< [length]
  void declare(Fields& f);
  double of_model(double noise) const { return model.value_or(0.25 * noise); }
};

/// What data and inputs may err in without that being news: standard deviations.
struct AllowanceCase : LastingAllowance {
  double inputs = 0.1;               ///< of what the model takes for known, relative
  double frame_displacement = 0;     ///< [length]
  std::optional<double> time_shift;  ///< absent: half the model's step [time]
  void declare(Fields& f);
};

}  // namespace tether
