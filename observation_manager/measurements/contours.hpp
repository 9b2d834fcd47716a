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
  StatedErrors stated_errors() const { return data.stated_errors(); }
  void declare(Fields& f);
};

}  // namespace tether
