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

/// The section `diagnosis` of a case: which effects may be missing, and how they are judged.
struct DiagnosisCase {
  std::vector<std::string> candidates, exclude, assumed;
  double step = 0.2, alpha = 0.05, unexplained = 0.1;
  int most = 3, refinements = 5, confirmed = 8;
  AllowanceCase allowed;
  bool numerics = false;
  void declare(Fields& f);
};

}  // namespace tether
