#pragma once

#include "common/config/curve_case.hpp"
#include "fluid/windkessels/outlets_case.hpp"

namespace tether {

/// What the case that outlets are for says of them.
struct OutletsBase {
  std::vector<std::string> outlets, inlets;
  std::optional<CurveCase> flow;  ///< of the only inlet
  UnitSystem units = UnitSystem::cgs();
  double start = 0, image_pressure = 0;  ///< [s], [mmHg]
};

/// Throws InputError.
OutletsBase read_outlets_base(const std::filesystem::path& case_file);

/// Areas of the outlets of a case's mesh [cm2], in the order of the names. Throws InputError also for a name that is
/// none.
std::vector<double> outlet_areas(const std::filesystem::path& case_file, const std::vector<std::string>& names);

}  // namespace tether
