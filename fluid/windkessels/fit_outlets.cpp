#include "fluid/windkessels/fit_outlets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/error.hpp"
#include "common/config/named_path.hpp"
#include "common/config/rules.hpp"
#include "fluid/windkessels/fit_elements.hpp"
#include "fluid/windkessels/outlets_base.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr double rounding = 2e-3;  ///< by which shares of three digits may miss 1
constexpr double most_flow = 1e5,
                 most_pressure = 1e5;  ///< [ml/s], [mmHg]: ten whales' hearts, an atmosphere hundredfold

double mmhg(double dyn_per_cm2) {
  return UnitSystem::cgs().to_mmhg(dyn_per_cm2);
}

/// [ml/mmHg]
double vessel_of(const OutletsCase& asked) {
  return asked.vessel_compliance / mmhg(1);
}

/// The outlets in the order of the case, or of the file, without one that the case has not, or with all of them.
Named<TargetOutletCase> outlets_of(const OutletsCase& asked, const std::optional<OutletsBase>& base) {
  if (!base) return asked.outlets;
  Named<TargetOutletCase> all;
  for (const std::string& name : base->outlets) all.emplace_back(name, TargetOutletCase{});
  if (asked.outlets.empty()) return all;
  for (const auto& [name, outlet] : asked.outlets) {
    const auto known = std::find_if(all.begin(), all.end(), [&, &n = name](const auto& one) { return one.first == n; });
    if (known == all.end())
      throw input_error("outlets.{}: {} has no such outlet; it has {}", name, asked.case_file.string(),
                        listed(base->outlets));
    known->second = outlet;
  }
  if (asked.outlets.size() < all.size())
    throw input_error("outlets: {} has {}; name all of them or none", asked.case_file.string(), listed(base->outlets));
  return all;
}

/// [cm2]; empty where nobody asks for them.
std::vector<double> areas_of(const OutletsCase& asked, const Named<TargetOutletCase>& outlets) {
  if (asked.split.by == "shares" && !asked.proximal.wave_speed) return {};
  std::vector<double> areas;
  for (const auto& [name, outlet] : outlets) areas.push_back(outlet.area.value_or(undefined));
  const auto missing = std::find_if(outlets.begin(), outlets.end(), [](const auto& one) { return !one.second.area; });
  if (missing == outlets.end()) return areas;
  if (asked.case_file.empty())
    throw input_error(
        "outlets.{}.area: must be given, since the flow's split or the wave speed asks for it and there "
        "is no case whose mesh has it",
        missing->first);
  std::vector<std::string> names;
  for (const auto& [name, outlet] : outlets) names.push_back(name);
  const std::vector<double> meshed = outlet_areas(asked.case_file, names);
  for (std::size_t i = 0; i < areas.size(); ++i)
    if (!outlets[i].second.area) areas[i] = meshed[i];
  return areas;
}

std::vector<double> given_shares(const Named<TargetOutletCase>& outlets) {
  if (outlets.size() == 1 && !outlets.front().second.share) return {1.0};
  std::vector<double> shares;
  for (const auto& [name, outlet] : outlets) {
    if (!outlet.share) throw input_error("outlets.{}.share: must be given with split.by: shares", name);
    shares.push_back(*outlet.share);
  }
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (std::abs(sum - 1) > rounding) throw input_error("outlets: their shares sum to {:.6g} and must sum to 1", sum);
  return shares;
}

/// Of the flow, with the sum 1.
std::vector<double> shares_of(const OutletsCase& asked, const Named<TargetOutletCase>& outlets,
                              const std::vector<double>& areas) {
  std::vector<double> shares = areas;
  if (asked.split.by == "shares") shares = given_shares(outlets);
  if (asked.split.by == "murray")
    for (double& share : shares) share = std::pow(share, asked.split.exponent / 2);
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= sum;
  return shares;
}

/// A beat of the flow, and what its values were multiplied by to have the mean that is asked for.
struct AskedFlow {
  CurveCase curve;
  PeriodicFlow flow;
  double factor = 1;
};

/// [ml/s]
AskedFlow flow_of(const OutletsCase& asked, const std::optional<OutletsBase>& base) {
  const bool own = asked.flow.has_value();
  if (!own && (!base->flow || base->flow->file.empty() || !base->flow->period))
    throw input_error("flow: must be given, since {} has not one inlet whose flow is a table with a period",
                      asked.case_file.string());
  AskedFlow made{own ? *asked.flow : *base->flow, {}, 1};
  const UnitSystem units = own ? UnitSystem::cgs() : base->units;
  if (made.curve.constant) throw input_error("flow: is constant: outlets are fitted to the flow of a beat");
  CurveCase::Table table = made.curve.table(units);
  for (double& value : table.values) value *= units.to_ml_per_s(made.curve.scale);
  made.flow = PeriodicFlow::closed(std::move(table.times), std::move(table.values), *made.curve.period);
  const double mean = made.flow.mean();
  if (mean <= 0)
    throw input_error("{}: the flow's mean over the beat is {:.4g} ml/s and must be positive", made.curve.file.string(),
                      mean);
  if (asked.mean_flow) made.factor = UnitSystem::cgs().to_ml_per_s(*asked.mean_flow) / mean;
  for (double& value : made.flow.values) value *= made.factor;
  if (!(made.flow.mean() <= most_flow && made.flow.most() <= 100 * most_flow))
    throw input_error("{}: the flow's mean over the beat is {:.4g} ml/s, more than any vessel carries: see {}",
                      made.curve.file.string(), made.flow.mean(), asked.mean_flow ? "mean_flow" : "flow.scale");
  return made;
}

std::vector<double> proximals_of(const ProximalCase& proximal, const std::vector<double>& resistances,
                                 const std::vector<double>& areas) {
  std::vector<double> made = resistances;
  for (std::size_t i = 0; i < made.size(); ++i)
    made[i] = proximal.wave_speed ? mmhg(proximal.density * *proximal.wave_speed / areas[i])
                                  : proximal.share * resistances[i];
  return made;
}

std::vector<Windkessel> by_pulse(const OutletsCase& asked, const Named<TargetOutletCase>& outlets,
                                 const std::vector<double>& shares, const std::vector<double>& areas,
                                 const PeriodicFlow& flow, FittedOutlets& result) {
  OutletTargets targets;
  for (const auto& [name, outlet] : outlets) targets.names.push_back(name);
  if (const double mean = mmhg(*asked.pressure.mean); !(mean <= most_pressure))
    throw input_error("pressure.mean: {:.4g} mmHg: is more than any vessel bears", mean);
  targets.mean_pressure = mmhg(*asked.pressure.mean - asked.pressure.venous);
  targets.pulse_pressure = mmhg(*asked.pressure.pulse);
  targets.shares = shares;
  targets.vessel = vessel_of(asked);
  targets.proximals = proximals_of(asked.proximal, resistances(targets.mean_pressure, shares, flow), areas);
  result.target_mean = mmhg(*asked.pressure.mean);
  result.target_pulse = targets.pulse_pressure;
  return fit_to_pulse(targets, flow);
}

std::vector<Windkessel> by_curve(const OutletsCase& asked, const std::vector<double>& shares, const PeriodicFlow& flow,
                                 OutletsFit& fit) {
  const CurveCase& curve = *asked.pressure.curve;
  if (curve.constant) throw input_error("pressure.curve: is constant: give mean and pulse instead");
  const CurveCase::Table table = curve.table(UnitSystem::cgs());
  const double venous = mmhg(asked.pressure.venous);
  MeasuredPressure measured{table.times, {}};
  for (const double value : table.values) measured.values.push_back(curve.scale * mmhg(value) - venous);
  const double mean = std::accumulate(measured.values.begin(), measured.values.end(), 0.0) /
                      static_cast<double>(measured.values.size());
  if (mean <= 0)
    throw input_error("{}: the mean pressure must be above the venous one, {:.4g} mmHg", curve.file.string(), venous);
  if (!(mean <= most_pressure))
    throw input_error("{}: the mean pressure is {:.4g} mmHg, more than any vessel bears: see pressure.curve.scale",
                      curve.file.string(), mean);
  if (measured.values.size() < 4)
    throw input_error("{}: {} pressures do not tell three elements", curve.file.string(), measured.values.size());
  const CurveFit found = fit_to_curve(measured, flow, vessel_of(asked));
  const auto [least, most] = std::minmax_element(measured.values.begin(), measured.values.end());
  fit.result.measured = BeatPressures{mean + venous, *most + venous, *least + venous, *most - *least};
  fit.result.misfit = found.misfit;
  for (std::size_t i = 0; i < measured.values.size(); ++i) {
    fit.measured_times.push_back(measured.times[i]);
    fit.measured_pressures.push_back(measured.values[i] + venous);
  }
  return divided(found.whole, shares);
}

/// Index of the time at which a run begins, among the times of a beat that has it.
Eigen::Index beginning(const PeriodicBeat& beat, double start) {
  const double period = beat.times.back() - beat.times.front();
  const double phase = start - period * std::floor((start - beat.times.front()) / period);
  const auto after = std::lower_bound(beat.times.begin(), beat.times.end(), phase - 1e-8 * period);
  return after == beat.times.end() ? 0 : after - beat.times.begin();
}

void fill(FittedOutlets& result, const Named<TargetOutletCase>& names, const std::vector<double>& shares,
          const std::vector<double>& areas, const std::vector<Windkessel>& elements, const PeriodicBeat& beat) {
  const Eigen::Index start = beginning(beat, result.start);
  PeriodicBeat one = beat;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    one.pressure = beat.flow.row(row);
    FittedOutlet& outlet = result.outlets.emplace_back();
    outlet.name = names[i].first;
    outlet.share = shares[i];
    if (!areas.empty()) outlet.area = areas[i];
    outlet.proximal_resistance = elements[i].proximal;
    outlet.distal_resistance = elements[i].distal;
    outlet.compliance = elements[i].compliance;
    outlet.initial_pressure = beat.stored(row, start) + result.venous_pressure;
    outlet.mean_flow = one.mean_pressure();
    outlet.flow_share = outlet.mean_flow / result.mean_flow;
    outlet.least_flow = beat.flow.row(row).minCoeff();
    outlet.most_flow = beat.flow.row(row).maxCoeff();
    result.compliance += elements[i].compliance;
  }
  const double venous = result.venous_pressure;
  result.reached = {beat.mean_pressure() + venous, beat.pressure.maxCoeff() + venous, beat.pressure.minCoeff() + venous,
                    beat.pulse_pressure()};
  result.initial_inlet_pressure = beat.pressure[start] + venous;
}

std::string elements_text(double value, const char* unit) {
  return fmt::format("{:.6g} {}", value, unit);
}

/// The case with these outlets, and with the flow where it is not the case's own.
Overlay overlay_of(const OutletsCase& asked, const OutletsBase& base, const AskedFlow& flow,
                   const FittedOutlets& result, const fs::path& folder) {
  Overlay overlay{asked.case_file, asked.name + "_run", {}, {}};  // a run has a folder of its own
  const auto set = [&](const std::string& field, const std::string& text) { overlay.values.push_back({field, text}); };
  if (asked.pressure.image) set("image.pressure", elements_text(base.image_pressure, "mmHg"));
  if (base.inlets.size() == 1 && (asked.flow || flow.factor != 1)) {
    const std::string inlet = "fluid.inlets." + base.inlets.front() + ".flow.";
    if (asked.flow) {
      set(inlet + "constant", "");
      set(inlet + "file", '"' + name_for(flow.curve.file, folder) + '"');
      set(inlet + "time", flow.curve.time);
      set(inlet + "value", flow.curve.value);
      set(inlet + "time_unit", flow.curve.time_unit);
      set(inlet + "value_unit", flow.curve.value_unit);
      set(inlet + "period", elements_text(*flow.curve.period, "s"));
    }
    set(inlet + "scale", number_text(flow.curve.scale * flow.factor));
  }
  for (const FittedOutlet& one : result.outlets) {
    const std::string outlet = "fluid.outlets." + one.name + ".";
    set(outlet + "type", "windkessel");
    set(outlet + "proximal_resistance", elements_text(one.proximal_resistance, "mmHg s/ml"));
    set(outlet + "distal_resistance", elements_text(one.distal_resistance, "mmHg s/ml"));
    set(outlet + "compliance", elements_text(one.compliance, "ml/mmHg"));
    set(outlet + "initial_pressure", elements_text(one.initial_pressure - base.image_pressure, "mmHg"));
    set(outlet + "distal_pressure", elements_text(result.venous_pressure - base.image_pressure, "mmHg"));
  }
  return overlay;
}

}  // namespace

OutletsFit fit_outlets(const OutletsCase& asked, const fs::path& folder) {
  std::optional<OutletsBase> base;
  if (!asked.case_file.empty()) base = read_outlets_base(asked.case_file);
  if (base && asked.pressure.image) base->image_pressure = mmhg(*asked.pressure.image);
  const Named<TargetOutletCase> outlets = outlets_of(asked, base);
  const AskedFlow flow = flow_of(asked, base);
  const std::vector<double> areas = areas_of(asked, outlets), shares = shares_of(asked, outlets, areas);
  OutletsFit fit;
  FittedOutlets& result = fit.result;
  result.name = asked.name;
  result.flow_from = flow.curve.file.string();
  result.period = flow.flow.period();
  result.start = base ? base->start : flow.flow.times.front();
  result.mean_flow = flow.flow.mean();
  result.venous_pressure = mmhg(asked.pressure.venous);
  const std::vector<Windkessel> elements = asked.has_curve()
                                               ? by_curve(asked, shares, flow.flow, fit)
                                               : by_pulse(asked, outlets, shares, areas, flow.flow, result);
  result.vessel_compliance = vessel_of(asked);
  const PeriodicFlow fine = flow.flow.refined({&result.start, 1}, pieces_of_a_beat);
  const ReachablePulse reachable = reachable_pulse(elements, fine, result.vessel_compliance);
  result.least_pulse = reachable.least, result.most_pulse = reachable.most;
  double whole = 0, proximal = 0;  // conductances
  for (const Windkessel& one : elements) whole += 1 / one.resistance(), proximal += 1 / one.proximal;
  result.resistance = 1 / whole;
  result.proximal_share = whole / proximal;
  fit.beat = periodic_beat(elements, fine, result.vessel_compliance);
  fill(result, outlets, shares, areas, elements, fit.beat);
  fit.beat.pressure.array() += result.venous_pressure;
  fit.beat.stored.array() += result.venous_pressure;
  if (base) fit.overlay = overlay_of(asked, *base, flow, result, folder);
  return fit;
}

}  // namespace tether
