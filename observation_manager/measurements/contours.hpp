#pragma once

#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// Contours in slices over time.
struct SlicesCase {
  std::filesystem::path file;
  std::string unit = "heading";
  std::vector<std::string> slices;
  std::optional<double> beat, period;
  int samples = 64;
  LumenDataCase data;
  void declare(Fields& f);
};

}  // namespace tether
