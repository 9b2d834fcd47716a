#pragma once

#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// Segmented surfaces over time.
struct SurfacesCase {
  std::filesystem::path file, folder;
  std::string pattern, unit;
  std::optional<double> first_time, interval, period;
  LumenDataCase data;
  StatedErrors stated_errors() const { return data.stated_errors(); }
  void declare(Fields& f);
};

}  // namespace tether
