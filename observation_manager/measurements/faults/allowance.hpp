#pragma once

#include "common/config/fields.hpp"

namespace tether {

/// What data and inputs may err in without that being news: standard deviations.
struct AllowanceCase {
  double inputs = 0.1;                              ///< of what the model takes for known, relative
  std::optional<double> model, bias, displacement;  ///< [length]; absent: shares of the noise's deviation
  double frame_displacement = 0;                    ///< [length]
  std::optional<double> time_shift;                 ///< absent: half the model's step [time]
  void declare(Fields& f);
};

}  // namespace tether
