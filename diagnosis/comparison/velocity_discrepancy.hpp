#pragma once

#include <functional>

#include "common/base/units.hpp"
#include "observation_manager/measurements/velocity_series.hpp"

namespace tether {

/// Measured velocities beside the run's, over points and components (D.6). All zero without points.
struct VelocityStatistics {
  int used = 0;                 ///< points with both
  double rms = 0, largest = 0;  ///< of the difference of a component [velocity]
  double measured = 0;          ///< root of the mean square of the measured components, the yardstick [velocity]
  double bias = 0;              ///< mean of measured minus run's, of one component; 0 with three [velocity]
  double effective = 0;         ///< number of independent points (D.6)
};

struct VelocityMoment {
  double time = 0, data_time = 0;  ///< in the run; as the data have it [time]
  bool held_out = false;
  int missed = 0;  ///< measured points outside the run's lumen
  VelocityStatistics found;
};

/// A series of velocities set against a run.
struct VelocityDiscrepancy {
  std::string name, unit;
  Noise noise;
  int components = 3, points = 0, outside = 0;  ///< outside: frames that the run does not reach
  std::vector<VelocityMoment> moments;          ///< in the order of the run's times
  VelocityStatistics training, held_out;        ///< over all moments of the kind; without an effective number
  /// Significance of a moment's bias (D.3); nothing without a noise, or with three components.
  std::optional<double> z(const VelocityMoment& moment) const;
};

/// The velocity of a run at the points of all series.
struct RunVelocity {
  double start = 0, end = 0;         ///< of the run [time]
  std::function<Points(double)> at;  ///< 3 x points, NaN outside the lumen [velocity]
  std::string unit;
};

/// `first`: number of the series' first point among those of the run.
VelocityDiscrepancy compare(const VelocitySeries& data, const RunVelocity& run, Eigen::Index first);

/// "pc_mr: velocities are 0.12 m/s off in root mean square (measured: 0.54 m/s; 2.4 times the noise), worst at 0.21 s"
std::vector<std::string> sentences_of(const VelocityDiscrepancy& velocity, const UnitSystem& units);

}  // namespace tether
