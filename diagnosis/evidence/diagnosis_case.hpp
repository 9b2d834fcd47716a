#pragma once

#include "observation_manager/measurements/faults/allowance.hpp"

namespace tether {

/// The section `diagnosis` of a case: which effects may be missing, and how they are judged.
struct DiagnosisCase {
  std::vector<std::string> candidates, also, exclude, assumed;
  double step = 1, alpha = 0.05, unexplained = 0.1;
  int most = 3, refinements = 5, confirmed = 8;
  AllowanceCase allowed;
  std::string numerics = "where_needed";
  bool coarse = true;
  void declare(Fields& f);
};

}  // namespace tether
