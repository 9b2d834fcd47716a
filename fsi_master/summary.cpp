#include "fsi_master/summary.hpp"

#include <nlohmann/json.hpp>

namespace tether {
namespace {

MeanAndMax mean_max(const MeanMax& m) {
  return {m.mean(), m.max};
}

std::optional<PressureRange> pressure_range(const MinMax& pressure, double image_pressure, const UnitSystem& units) {
  if (pressure.empty()) return std::nullopt;
  return PressureRange{.min = pressure.min,
                       .max = pressure.max,
                       .unit = units.symbol(dimension::pressure),
                       .min_mmhg = units.to_mmhg(pressure.min),
                       .max_mmhg = units.to_mmhg(pressure.max),
                       .relative_to_mmhg = units.to_mmhg(image_pressure)};
}

/// A number of each process, and their sum.
std::map<std::string, double> by_process(const std::vector<RunProcess>& all, const RunStatistics& s,
                                         double ProcessTotals::*number) {
  std::map<std::string, double> of;
  double total = 0;
  for (std::size_t i = 0; i < all.size(); ++i) total += of[all[i].name] = s.processes.at(i).*number;
  of["total"] = total;
  return of;
}

/// Wall clock and CPU are of the same steps: all of the run, those before a resume included.
void add_costs(RunSummary& summary, const std::vector<RunProcess>& processes, const RunStatistics& s) {
  const double steps = s.evaluations.count;
  summary.loop_cpu_seconds = by_process(processes, s, &ProcessTotals::loop_cpu_seconds);
  summary.cpu_seconds = by_process(processes, s, &ProcessTotals::cpu_seconds);
  summary.peak_memory_mb = by_process(processes, s, &ProcessTotals::peak_memory_mb);
  summary.wall_seconds = s.wall_seconds;
  summary.seconds_per_step = steps > 0 ? s.wall_seconds / steps : 0.0;
  summary.cpu_seconds_per_step = steps > 0 ? summary.loop_cpu_seconds["total"] / steps : 0.0;
  for (const RunProcess& process : processes) {
    if (process.unknowns > 0) summary.unknowns[process.name] = process.unknowns;
    summary.versions[process.name] = process.program;
  }
}

void add_results(RunSummary& summary, const Simulation& simulation) {
  const UnitSystem& units = simulation.plan().units;
  const RunStatistics& s = simulation.statistics();
  summary.coupling_iterations = mean_max(s.evaluations);
  summary.krylov_iterations = mean_max(s.krylov_iterations);
  summary.repeated_steps = static_cast<std::int64_t>(s.repeated_steps);
  summary.mass_balance_error_max = s.mass_balance_error;
  summary.pressure = pressure_range(s.pressure, simulation.plan().image_pressure, units);
  summary.max_displacement = s.max_displacement;
  summary.max_displacement_mm = units.to_mm(s.max_displacement);
  for (const auto& point : simulation.followed()) summary.points[point.name] = {point.node, point.distance};
}

ObserverWork work_of(const ObserverStatistics& s, double gain, const UnitSystem& units) {
  return {gain, s.corrections, s.weakened, s.largest, units.to_mm(s.largest)};
}

}  // namespace

RunSummary summary_of(const Simulation& simulation, const RunFacts& facts) {
  const RunPlan& plan = simulation.plan();
  RunSummary summary;
  summary.case_name = facts.case_name;
  summary.title = facts.title;
  summary.case_file = facts.case_file;
  summary.units = {plan.units.name(), plan.units.symbol(dimension::length), plan.units.symbol(dimension::pressure),
                   plan.units.symbol(dimension::flow)};
  summary.steps = plan.last_step;
  if (plan.resume) summary.resumed_at_step = simulation.first_step();
  summary.dt = plan.dt;
  summary.time = {plan.start, plan.time_at(plan.last_step)};
  summary.coupling_method = facts.method;
  add_costs(summary, facts.processes, simulation.statistics());
  add_results(summary, simulation);
  if (const Observer* observer = simulation.observer())
    summary.observer = work_of(observer->statistics(), facts.observer_gain, plan.units);
  summary.interface = facts.interface;
  summary.notices = facts.notices;
  summary.effective_case.text = facts.effective_case;
  summary.periodicity = facts.periodicity;
  summary.rest = facts.rest;
  summary.written = facts.written;
  summary.made_from = facts.made_from;
  summary.made_from.coupled_otherwise = simulation.coupled_otherwise();
  return summary;
}

std::string merged_json(const std::vector<std::string>& texts) {
  auto all = nlohmann::ordered_json::object();
  for (const std::string& text : texts) {
    const auto one = nlohmann::ordered_json::parse(text, nullptr, false);
    if (one.is_object()) all.update(one);
  }
  return all.dump();
}

}  // namespace tether
