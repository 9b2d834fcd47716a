#pragma once

#include <map>
#include <string>

#include "common/io/point_series.hpp"

namespace tether {

/// lumen.motion: the displacements of the lumen's nodes from their imaged positions, at every step of a run.
struct LumenMotionWriter : PointSeriesWriter {
  LumenMotionWriter(std::filesystem::path path, Points imaged);
};

class LumenMotion {
 public:
  /// Throws InputError for a file that is none, or damaged.
  explicit LumenMotion(const std::filesystem::path& path);
  /// Throws InputError if it holds less than a run of so many steps.
  void check_has(std::int64_t steps) const { series_.check_has(steps); }

  const Points& imaged() const { return series_.points(); }
  const std::vector<double>& times() const { return series_.times(); }
  /// Positions at a time, linear between steps. Throws InputError for a time outside the run.
  Points at(double time) const { return imaged() + series_.vectors_at(time); }

 private:
  PointSeries series_;
};

/// blood.velocity: the velocity at the points of the case's measurements of it, at every step of a run; NaN where a
/// point lies outside the lumen.
struct BloodVelocityWriter : PointSeriesWriter {
  BloodVelocityWriter(std::filesystem::path path, Points points);
};

struct BloodVelocity : PointSeries {
  /// Throws InputError for a file that is none.
  explicit BloodVelocity(const std::filesystem::path& path);
};

/// Throws InputError if the run's table is missing, damaged or has fewer rows than steps.
void check_has_rows(const std::filesystem::path& table, std::int64_t steps);

/// Throws InputError if what a run of so many steps left in its folder (lumen.motion, timeseries.csv, and
/// blood.velocity where there is one) is missing, damaged or cut short.
void check_is_whole(const std::filesystem::path& folder, std::int64_t steps);

/// Of those of these files that a run has left in its folder, a hash of what each holds.
std::map<std::string, std::string> hashes_of_results(const std::filesystem::path& folder);

}  // namespace tether
