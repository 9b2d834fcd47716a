#include "diagnosis/comparison/beat_quantities.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

constexpr double percent = 100, per_thousand = 1000;

/// Quantities of one run, as its columns allow.
class Beat {
 public:
  Beat(const FinishedMotion& run, const BeatFacts& facts) : run_(run), facts_(facts) {}

  std::vector<QuantityFound> all() {
    for (const std::string& inlet : facts_.inlets) add_pressures(inlet);
    add_stiffness();
    add_flows();
    add_stresses();
    return std::move(all_);
  }

 private:
  bool has(const std::string& column) const {
    return std::find(facts_.columns.begin(), facts_.columns.end(), column) != facts_.columns.end();
  }
  /// The last period of a column.
  RunTrace beat(const std::string& column) const {
    RunTrace trace = run_.trace(column);
    if (facts_.period <= 0 || trace.times.empty()) return trace;
    const double slack = 1e-9 * facts_.period, begin = trace.times.back() - facts_.period - slack;
    const auto first = std::lower_bound(trace.times.begin(), trace.times.end(), begin) - trace.times.begin();
    trace.times.erase(trace.times.begin(), trace.times.begin() + first);
    trace.values.erase(trace.values.begin(), trace.values.begin() + first);
    return trace;
  }
  struct Bounds {
    double least, most;
  };
  Bounds bounds(const std::string& column) const {
    const RunTrace trace = beat(column);
    const auto [least, most] = std::minmax_element(trace.values.begin(), trace.values.end());
    return {*least, *most};
  }
  void add(Quantity quantity, const std::string& where, double value, const std::string& unit) {
    all_.push_back({quantity, where, value, {}, {}, unit});
  }

  void add_pressures(const std::string& inlet) {
    const std::string column = "fluid." + inlet + ".pressure";
    if (!has(column)) return;
    const Bounds p = bounds(column);
    add(Quantity::systolic_pressure, inlet, facts_.units.to_mmhg(p.most + facts_.imaged), "mmHg");
    add(Quantity::diastolic_pressure, inlet, facts_.units.to_mmhg(p.least + facts_.imaged), "mmHg");
  }

  /// (D.22)
  void add_stiffness() {
    if (!has("fluid.volume")) return;
    const Bounds volume = bounds("fluid.volume");
    const double strain = volume.most / volume.least - 1;
    add(Quantity::strain, "", percent * strain, "%");
    if (facts_.inlets.empty() || !has("fluid." + facts_.inlets.front() + ".pressure")) return;
    const Bounds p = bounds("fluid." + facts_.inlets.front() + ".pressure");
    const double distensibility = strain / (p.most - p.least);
    add(Quantity::distensibility, "", per_thousand * strain / facts_.units.to_mmhg(p.most - p.least), "1e-3/mmHg");
    if (facts_.density <= 0) return;
    const double velocity = 1 / std::sqrt(facts_.density * distensibility);
    add(Quantity::pulse_wave_velocity, "", velocity * facts_.units.in_si(dimension::velocity), "m/s");
  }

  void add_flows() {
    std::vector<double> volumes;
    double sum = 0;
    for (const std::string& outlet : facts_.outlets) {
      const std::string column = "fluid." + outlet + ".flow";
      if (!has(column)) return;
      add(Quantity::peak_flow, outlet, facts_.units.to_ml_per_s(bounds(column).most), "ml/s");
      volumes.push_back(integral(beat(column)));
      sum += volumes.back();
    }
    if (volumes.size() < 2 || sum == 0) return;
    for (std::size_t k = 0; k < volumes.size(); ++k)
      add(Quantity::flow_share, facts_.outlets[k], percent * volumes[k] / sum, "%");
  }
  void add_stresses() {
    const auto in = [&](double stress, double unit) { return stress * facts_.units.in_si(dimension::pressure) / unit; };
    if (has("solid.peak_stress")) add(Quantity::peak_wall_stress, "", in(bounds("solid.peak_stress").most, 1e3), "kPa");
    if (!has("fluid.wall_shear")) return;
    const RunTrace shear = beat("fluid.wall_shear");
    const double lasts = shear.times.back() - shear.times.front();
    if (lasts > 0) add(Quantity::wall_shear, "", in(integral(shear) / lasts, 1), "Pa");
  }
  /// Over time.
  static double integral(const RunTrace& trace) {
    double sum = 0;
    for (std::size_t i = 1; i < trace.times.size(); ++i)
      sum += 0.5 * (trace.values[i] + trace.values[i - 1]) * (trace.times[i] - trace.times[i - 1]);
    return sum;
  }

  const FinishedMotion& run_;
  const BeatFacts& facts_;
  std::vector<QuantityFound> all_;
};

}  // namespace

std::vector<QuantityFound> beat_quantities(const FinishedMotion& run, const BeatFacts& facts) {
  return Beat(run, facts).all();
}

}  // namespace tether
