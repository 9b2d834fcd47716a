#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// The lumen of a finished run.
struct RunMotion {
  double start = 0, end = 0;                ///< of the run [time]
  Points imaged;                            ///< one column an interface node [length]
  std::function<Points(double)> positions;  ///< at a time of the run [length]
};

/// A column of a run's table of times.
struct RunTrace {
  std::vector<double> times, values;
  std::string unit;
};

/// A finished run, as measurements see it: its lumen, the columns of its table, the velocities that it recorded.
struct FinishedMotion {
  RunMotion motion;
  std::function<RunTrace(const std::string&)> trace;
  /// At points of space that the run was told of, 3 x points, NaN outside the lumen [velocity].
  std::function<Points(const Points&, double)> velocity = {};
  std::string failure = {};                          ///< why it did not come to its end
  bool failed() const { return !motion.positions; }  ///< it did not
};

/// What a model says at one time, while it runs.
struct ModelMoment {
  std::vector<std::string> names;  ///< of columns of timeseries.csv
  std::vector<double> values;      ///< theirs [case's units]
  Points points, velocities;       ///< where the velocity was asked for, and what it is; NaN outside the lumen
  Points lumen;                    ///< positions of the interface's nodes; none if nobody asked [length]
  /// Throws InputError if there is no such column.
  double value(const std::string& column) const;
  /// The velocity at points that were asked for, one after the other.
  Points velocity_at(const Points& some) const;
};

/// When the run was at the moment that data call `time`: of a periodic series in the last period that the run covers;
/// of one frame that holds at all times (NaN) at the end. Nothing if the run was not there, by more than `tolerance`.
std::optional<double> time_in_run(double time, double period, double start, double end, double tolerance);

/// Where among `all` points those of `some` begin, which stand there one after the other. Throws InputError if they
/// do not.
Eigen::Index place_of(const Points& some, const Points& all);

}  // namespace tether
