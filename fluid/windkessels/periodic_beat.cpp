#include "fluid/windkessels/periodic_beat.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// How one mode dz/dt = -rate z + f(t) goes over a step in which f is linear:
///   z(h) = keep z(0) + first f(0) + last f(h)  (M.11)
struct ModeStep {
  double keep = 1, first = 0, last = 0;
  ModeStep(double rate, double h) {
    const double x = rate * h, whole = -std::expm1(-x) / rate;
    keep = std::exp(-x);
    last = x < 1e-3 ? h * (0.5 - x / 6 + x * x / 24) : (1 - whole / h) / rate;  // the other form cancels
    first = whole - last;
  }
};

/// The modes of the pressures stored in outlets that leave one vessel, after that of the vessel itself if it stores
/// any.
struct Modes {
  Eigen::VectorXd rates, forcing;  ///< forcing: of each mode by a unit of flow
  Eigen::MatrixXd shapes;          ///< stored pressures of each mode, a column each
};

/// Of C dP/dt = -M P + f q, M symmetric: in C^(1/2) P.
Modes modes_of(const Eigen::MatrixXd& M, const Eigen::VectorXd& compliances, const Eigen::VectorXd& f) {
  const Eigen::VectorXd scale = compliances.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * M * scale.asDiagonal());
  return {solver.eigenvalues(), solver.eigenvectors().transpose() * scale.asDiagonal() * f,
          scale.asDiagonal() * solver.eigenvectors()};
}

Eigen::VectorXd conductances(std::span<const Windkessel> outlets) {
  Eigen::VectorXd g(static_cast<Eigen::Index>(outlets.size()));
  for (Eigen::Index i = 0; i < g.size(); ++i) g[i] = 1 / outlets[static_cast<std::size_t>(i)].proximal;
  return g;
}

/// M = diag(g + 1/R_d) - g g'/G, f = g/G; or, with the vessel's pressure first, M = [G -g'; -g diag(g + 1/R_d)] and all
/// of the flow into it (M.10).
Modes modes_of(std::span<const Windkessel> outlets, const Eigen::VectorXd& g, double vessel) {
  const Eigen::Index n = g.size(), own = vessel > 0 ? 1 : 0;
  const double G = g.sum();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(own + n, own + n);
  Eigen::VectorXd compliances(own + n), f = Eigen::VectorXd::Zero(own + n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Windkessel& one = outlets[static_cast<std::size_t>(i)];
    M(own + i, own + i) = g[i] + 1 / one.distal;
    compliances[own + i] = one.compliance;
  }
  if (own == 0) return modes_of(M - g * g.transpose() / G, compliances, g / G);
  M(0, 0) = G;
  M.row(0).tail(n) = -g;
  M.col(0).tail(n) = -g;
  compliances[0] = vessel;
  f[0] = 1;
  return modes_of(M, compliances, f);
}

/// A mode's values over a beat that ends as it begins.
Eigen::RowVectorXd periodic_mode(double rate, double forcing, const PeriodicFlow& flow) {
  Eigen::RowVectorXd z = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(flow.times.size()));
  const auto march = [&] {
    for (std::size_t i = 1; i < flow.times.size(); ++i) {
      const ModeStep step(rate, flow.times[i] - flow.times[i - 1]);
      const auto k = static_cast<Eigen::Index>(i);
      z[k] = step.keep * z[k - 1] + forcing * (step.first * flow.values[i - 1] + step.last * flow.values[i]);
    }
  };
  march();
  z[0] = z[z.size() - 1] / -std::expm1(-rate * flow.period());
  march();
  return z;
}

double integral(const std::vector<double>& times, std::span<const double> values) {
  double sum = 0;
  for (std::size_t i = 1; i < times.size(); ++i) sum += 0.5 * (values[i] + values[i - 1]) * (times[i] - times[i - 1]);
  return sum;
}

}  // namespace

double PeriodicFlow::mean() const {
  return integral(times, values) / period();
}

double PeriodicFlow::least() const {
  return *std::min_element(values.begin(), values.end());
}

double PeriodicFlow::most() const {
  return *std::max_element(values.begin(), values.end());
}

double PeriodicFlow::at(double time) const {
  time -= period() * std::floor((time - times.front()) / period());
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.end()) return values.back();
  if (after == times.begin()) return values.front();
  const auto i = static_cast<std::size_t>(after - times.begin());
  const double s = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - s) * values[i - 1] + s * values[i];
}

PeriodicFlow PeriodicFlow::closed(std::vector<double> times, std::vector<double> values, double period) {
  TETHER_ASSERT(!times.empty() && times.size() == values.size(), "{} {}", times.size(), values.size());
  const double end = times.front() + period;
  if (times.size() > 1 && times.back() >= end - 1e-9 * period) {
    times.back() = end;
  } else {
    times.push_back(end);
    values.push_back(values.front());
  }
  return {std::move(times), std::move(values)};
}

PeriodicFlow PeriodicFlow::refined(std::span<const double> more, int pieces) const {
  std::vector<double> all = times;
  const double T = period(), longest = T / pieces;
  for (const double time : more) all.push_back(time - T * std::floor((time - times.front()) / T));
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double length = times[i] - times[i - 1];
    const int parts = static_cast<int>(std::ceil(length / longest));
    for (int part = 1; part < parts; ++part) all.push_back(times[i - 1] + length * part / parts);
  }
  std::sort(all.begin(), all.end());
  PeriodicFlow fine;
  for (const double time : all)
    if (fine.times.empty() || time > fine.times.back() + 1e-9 * T) fine.times.push_back(time);
  fine.times.back() = times.back();
  for (const double time : fine.times) fine.values.push_back(at(time));
  fine.values.back() = values.back();
  return fine;
}

double PeriodicBeat::mean_pressure() const {
  return integral(times, {pressure.data(), times.size()}) / (times.back() - times.front());
}

PeriodicBeat periodic_beat(std::span<const Windkessel> outlets, const PeriodicFlow& flow, double vessel) {
  const Eigen::VectorXd g = conductances(outlets);
  const Modes modes = modes_of(outlets, g, vessel);
  Eigen::MatrixXd values(modes.rates.size(), static_cast<Eigen::Index>(flow.times.size()));
  for (Eigen::Index k = 0; k < values.rows(); ++k)
    values.row(k) = periodic_mode(modes.rates[k], modes.forcing[k], flow);
  const Eigen::MatrixXd pressures = modes.shapes * values;
  PeriodicBeat beat;
  beat.times = flow.times;
  beat.inlet_flow = Eigen::Map<const Eigen::VectorXd>(flow.values.data(), values.cols());
  beat.stored = pressures.bottomRows(g.size());
  if (vessel > 0)
    beat.pressure = pressures.row(0);
  else
    beat.pressure = (beat.inlet_flow + beat.stored.transpose() * g) / g.sum();
  beat.flow = g.asDiagonal() * (beat.pressure.transpose().replicate(g.size(), 1) - beat.stored);
  return beat;
}

}  // namespace tether
