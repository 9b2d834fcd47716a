#include "fluid/windkessels/fit_elements.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// Discharge times between which a compliance is sought, in periods: beyond, the pulse pressure is its limit.
constexpr double shortest_discharge = 1e-4, longest_discharge = 1e5;

void set_compliance(std::vector<Windkessel>& outlets, double whole, const std::vector<double>& shares) {
  for (std::size_t i = 0; i < outlets.size(); ++i) outlets[i].compliance = whole * shares[i];
}

std::vector<Windkessel> resistive(const OutletTargets& targets, const PeriodicFlow& flow) {
  const std::vector<double> all = resistances(targets.mean_pressure, targets.shares, flow);
  std::vector<Windkessel> outlets(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (targets.proximals[i] >= all[i])
      throw input_error(
          "outlets.{}: its proximal resistance would be {:.4g} mmHg s/ml, of {:.4g} in all that its mean pressure and "
          "flow allow",
          targets.names[i], targets.proximals[i], all[i]);
    outlets[i] = {targets.proximals[i], all[i] - targets.proximals[i], 1};
  }
  return outlets;
}

/// The pulse pressure falls as the compliance grows.
double compliance_for(std::vector<Windkessel> outlets, const OutletTargets& targets, const PeriodicFlow& flow) {
  const double unit = flow.period() * flow.mean() / targets.mean_pressure;  // of a period's discharge
  double low = std::log(shortest_discharge * unit), high = std::log(longest_discharge * unit);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    set_compliance(outlets, std::exp(middle), targets.shares);
    (periodic_beat(outlets, flow, targets.vessel).pulse_pressure() > targets.pulse_pressure ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

/// Of the vessel, with which outlets without any have the asked pulse: the largest that can be asked for.
double largest_vessel(const std::vector<Windkessel>& outlets, const OutletTargets& targets, const PeriodicFlow& flow) {
  double low = 0, high = targets.vessel;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (reachable_pulse(outlets, flow, middle).most > targets.pulse_pressure ? low : high) = middle;
  }
  return low;
}

/// Index of each measured time in a flow that has them all.
std::vector<Eigen::Index> indices_of(const std::vector<double>& times, const PeriodicFlow& flow) {
  std::vector<Eigen::Index> found;
  for (double time : times) {
    time -= flow.period() * std::floor((time - flow.times.front()) / flow.period());
    const auto after = std::lower_bound(flow.times.begin(), flow.times.end(), time - 1e-8 * flow.period());
    found.push_back(
        std::min<Eigen::Index>(after - flow.times.begin(), static_cast<Eigen::Index>(flow.times.size()) - 1));
  }
  return found;
}

Windkessel of_logarithms(const Eigen::Vector3d& x) {
  return {std::exp(x[0]), std::exp(x[1]), std::exp(x[2])};
}

}  // namespace

std::vector<double> resistances(double mean_pressure, const std::vector<double>& shares, const PeriodicFlow& flow) {
  std::vector<double> all;
  for (const double share : shares) all.push_back(mean_pressure / (share * flow.mean()));  // (M.12)
  return all;
}

ReachablePulse reachable_pulse(std::span<const Windkessel> outlets, const PeriodicFlow& flow, double vessel) {
  if (vessel > 0) {
    const auto pulse = [&](double factor) {
      std::vector<Windkessel> scaled(outlets.begin(), outlets.end());
      for (Windkessel& one : scaled) one.compliance *= factor;
      return periodic_beat(scaled, flow, vessel).pulse_pressure();
    };
    return {pulse(1e6), pulse(1e-6)};
  }
  double proximal = 0, whole = 0;
  for (const Windkessel& one : outlets) proximal += 1 / one.proximal, whole += 1 / one.resistance();
  const double swing = flow.most() - flow.least();
  return {swing / proximal, swing / whole};
}

std::vector<Windkessel> fit_to_pulse(const OutletTargets& targets, const PeriodicFlow& flow) {
  std::vector<Windkessel> outlets = resistive(targets, flow);
  set_compliance(outlets, 1, targets.shares);
  const ReachablePulse reachable = reachable_pulse(outlets, flow, targets.vessel);
  if (targets.vessel > 0 && targets.pulse_pressure >= reachable.most * 0.999 &&
      targets.pulse_pressure < reachable_pulse(outlets, flow, 0).most)
    throw input_error(
        "vessel_compliance: {:.4g} ml/mmHg: leave a pulse pressure of {:.4g} mmHg at most, where {:.4g} are asked: "
        "must be below {:.3g}",
        targets.vessel, reachable.most, targets.pulse_pressure, largest_vessel(outlets, targets, flow));
  if (targets.pulse_pressure <= reachable.least * 1.001 || targets.pulse_pressure >= reachable.most * 0.999)
    throw input_error(
        "a pulse pressure of {:.4g} mmHg cannot be reached: with this flow and mean pressure it is {:.4g} mmHg without "
        "any compliance, and {:.4g} mmHg with an infinite one, which is what the proximal resistances leave",
        targets.pulse_pressure, reachable.most, reachable.least);
  const PeriodicFlow fine = flow.refined({}, pieces_of_a_beat);
  set_compliance(outlets, compliance_for(outlets, targets, fine), targets.shares);
  return outlets;
}

CurveFit fit_to_curve(const MeasuredPressure& measured, const PeriodicFlow& flow, double vessel) {
  const PeriodicFlow fine = flow.refined(measured.times, 2);
  const std::vector<Eigen::Index> at = indices_of(measured.times, fine);
  const Eigen::Map<const Eigen::VectorXd> values(measured.values.data(), static_cast<Eigen::Index>(at.size()));
  const auto misfit = [&](const Eigen::Vector3d& x) -> Eigen::VectorXd {
    const Windkessel one = of_logarithms(x);
    return periodic_beat({&one, 1}, fine, vessel).pressure(at) - values;
  };
  const double resistance = values.mean() / flow.mean();
  Eigen::Vector3d x{std::log(0.05 * resistance), std::log(0.95 * resistance), std::log(flow.period() / resistance)};
  Eigen::VectorXd now = misfit(x);
  double damping = 1e-3;
  for (int step = 0; step < 200; ++step) {
    constexpr double difference = 1e-6;
    Eigen::MatrixXd slope(now.size(), 3);
    for (int k = 0; k < 3; ++k) slope.col(k) = (misfit(x + difference * Eigen::Vector3d::Unit(k)) - now) / difference;
    Eigen::Matrix3d normal = slope.transpose() * slope;
    normal.diagonal() *= 1 + damping;
    const Eigen::Vector3d change = -normal.ldlt().solve(slope.transpose() * now);
    const Eigen::VectorXd then = misfit(x + change);
    const bool better = then.squaredNorm() < now.squaredNorm();
    damping = better ? damping / 3 : damping * 5;
    if (better) x += change, now = then;
    if (change.norm() < 1e-10) break;
  }
  return {of_logarithms(x), std::sqrt(now.squaredNorm() / static_cast<double>(now.size()))};
}

std::vector<Windkessel> divided(const Windkessel& whole, const std::vector<double>& shares) {
  std::vector<Windkessel> outlets;
  for (const double share : shares)
    outlets.push_back({whole.proximal / share, whole.distal / share, whole.compliance * share});
  return outlets;
}

}  // namespace tether
