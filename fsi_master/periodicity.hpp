#pragma once

#include <filesystem>
#include <span>

#include "common/base/units.hpp"
#include "fsi_master/results/periodicity.hpp"

namespace tether {

/// A beat that changes pressure and volume by no more, at any phase, is periodic: 0.5 %.
inline constexpr double periodic_limit = 5e-3;

/// What a run was at the end of each step. Pressures are absolute, of each inlet.
struct BeatingRun {
  double start = 0;  ///< [s]
  std::vector<double> times;
  std::vector<std::vector<double>> pressures;
  std::vector<double> volumes;
};

/// Changes from beat to beat, each complete beat from the second on; earlier beats are taken linear between steps.
/// Nothing if there are not two, or a mean pressure or volume is not positive.
std::optional<Periodicity> periodicity_of(const BeatingRun& run, double period);

/// Of all curves of a case's inlets; nothing if one has none, or another.
std::optional<double> period_of_inlets(const std::filesystem::path& case_file, const UnitSystem& units);

/// The same of a run's table, timeseries.csv, with the inlets and the period of the case. Nothing also if its inlets'
/// curves have no period, or not the same, or the blood's code does not tell pressures and volume.
/// image_pressure: to which the table's pressures are relative, in the case's units.
std::optional<Periodicity> periodicity_of(const std::filesystem::path& table, const std::filesystem::path& case_file,
                                          double start, double image_pressure, const UnitSystem& units);

}  // namespace tether
