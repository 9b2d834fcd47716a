#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace tether {

/// A three-element Windkessel: p = P + proximal Q, compliance dP/dt + P/distal = Q (M.10). Any consistent units.
struct Windkessel {
  double proximal = 0, distal = 0, compliance = 0;
  double resistance() const { return proximal + distal; }
};

/// A flow that repeats, linear between its times; the last one is a period after the first.
struct PeriodicFlow {
  std::vector<double> times, values;
  double period() const { return times.back() - times.front(); }
  double mean() const;
  double least() const;
  double most() const;
  double at(double time) const;
  /// Closes the beat: its last value is the first one's, unless the table has one there.
  static PeriodicFlow closed(std::vector<double> times, std::vector<double> values, double period);
  /// The same function with more times: these (of any period), and enough for `pieces` in a period.
  PeriodicFlow refined(std::span<const double> more, int pieces) const;
};

/// A beat in which the vessel and all outlets end as they began. Pressures are relative to that behind the outlets.
struct PeriodicBeat {
  std::vector<double> times;
  Eigen::VectorXd inlet_flow, pressure;  ///< into the vessel; there, where outlets are joined
  Eigen::MatrixXd stored, flow;          ///< an outlet a row, a time a column
  double mean_pressure() const;
  double pulse_pressure() const { return pressure.maxCoeff() - pressure.minCoeff(); }
};

/// The periodic state of Windkessels that leave one vessel, into which `flow` goes (M.10, M.11): exact at the flow's
/// times. Elements must be positive. vessel: its own compliance; with 0 it stores nothing.
PeriodicBeat periodic_beat(std::span<const Windkessel> outlets, const PeriodicFlow& flow, double vessel = 0);

}  // namespace tether
