#pragma once

#include <string>

#include "fluid/windkessels/periodic_beat.hpp"

namespace tether {

/// What several outlets are to do together. Pressures are relative to that behind the outlets.
struct OutletTargets {
  double mean_pressure = 0, pulse_pressure = 0;
  std::vector<std::string> names;
  std::vector<double> shares;     ///< of the flow, one for each outlet, with the sum 1
  std::vector<double> proximals;  ///< resistances before the reservoirs, one for each outlet
  double vessel = 0;              ///< compliance of the vessel itself
};

/// What pulse pressures there are for these means and proximal resistances: with reservoirs that take up anything, and
/// with none.
struct ReachablePulse {
  double least = 0, most = 0;
};

/// Resistances by mean pressure and shares (M.12); of all outlets together they are mean_pressure over the mean flow.
std::vector<double> resistances(double mean_pressure, const std::vector<double>& shares, const PeriodicFlow& flow);

/// Of these outlets' resistances; of their compliances only how they are shared is asked.
ReachablePulse reachable_pulse(std::span<const Windkessel> outlets, const PeriodicFlow& flow, double vessel = 0);

/// Elements with which the periodic state has the mean and pulse pressure. Compliances are shared as the flow; their
/// sum is found by bisection (M.13). Throws InputError, with what can be reached, if the pulse pressure cannot be, or a
/// proximal resistance is not below its outlet's whole one.
std::vector<Windkessel> fit_to_pulse(const OutletTargets& targets, const PeriodicFlow& flow);

/// A pressure that was measured over a beat, relative to that behind the outlets.
struct MeasuredPressure {
  std::vector<double> times, values;
};

/// The one Windkessel whose periodic pressure differs least from the measured one in the mean of squares over its
/// times: Levenberg-Marquardt in the logarithms of the elements.
struct CurveFit {
  Windkessel whole;
  double misfit = 0;  ///< root mean square
};
CurveFit fit_to_curve(const MeasuredPressure& measured, const PeriodicFlow& flow, double vessel = 0);

/// Windkessels alike but in size, which together are the one: each takes its share of the flow at every moment.
std::vector<Windkessel> divided(const Windkessel& whole, const std::vector<double>& shares);

/// Pieces in which a period is divided at least, so that extremes between them are not missed.
inline constexpr int pieces_of_a_beat = 1000;

}  // namespace tether
