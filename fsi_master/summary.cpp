#include "fsi_master/summary.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

Json mean_max(const MeanMax& m) {
  return {{"mean", m.mean()}, {"max", m.max}};
}

Json pressure_range(const Extent& pressure, double image_pressure, const UnitSystem& units) {
  if (pressure.empty()) return nullptr;
  return {{"min", pressure.min},
          {"max", pressure.max},
          {"unit", units.symbol(dimension::pressure)},
          {"min_mmHg", units.to_mmhg(pressure.min)},
          {"max_mmHg", units.to_mmhg(pressure.max)},
          {"relative_to_mmHg", units.to_mmhg(image_pressure)}};
}

/// A number of each process, and their sum.
template <class Number>
Json processes(const std::vector<ProcessCost>& all, const Number& number) {
  Json json;
  double total = 0;
  for (const auto& process : all) {
    json[process.name] = number(process);
    total += number(process);
  }
  json["total"] = total;
  return json;
}

void add_costs(Json& json, const RunFacts& facts, const RunStatistics& s, double steps_now) {
  const auto& all = facts.processes;
  const auto loop = processes(all, [](const ProcessCost& p) { return p.loop_cpu_seconds; });
  json["wall_seconds"] = s.wall_seconds;
  json["seconds_per_step"] = s.evaluations.count > 0 ? s.wall_seconds / s.evaluations.count : 0.0;
  json["cpu_seconds_per_step"] = steps_now > 0 ? loop["total"].get<double>() / steps_now : 0.0;
  json["cpu_seconds"] = processes(all, [](const ProcessCost& p) { return p.usage.cpu_seconds; });
  json["loop_cpu_seconds"] = loop;
  json["peak_memory_mb"] = processes(all, [](const ProcessCost& p) { return p.usage.peak_memory_mb; });
  for (const auto& process : all)
    if (process.unknowns > 0) json["unknowns"][process.name] = process.unknowns;
}

void add_results(Json& json, const Simulation& simulation) {
  const UnitSystem& units = simulation.plan().units;
  const RunStatistics& s = simulation.statistics();
  json["coupling_iterations"] = mean_max(s.evaluations);
  json["krylov_iterations"] = mean_max(s.krylov_iterations);
  json["repeated_steps"] = s.repeated_steps;
  json["mass_balance_error_max"] = s.mass_balance_error;
  json["pressure"] = pressure_range(s.pressure, simulation.plan().image_pressure, units);
  json["max_displacement"] = s.max_displacement;
  json["max_displacement_mm"] = units.to_mm(s.max_displacement);
  for (const auto& point : simulation.followed())
    json["points"][point.name] = {{"interface_node", point.node}, {"distance_to_node", point.distance}};
}

/// What a state observer did: the run follows the data, and is no evidence for the model.
Json observer_facts(const ObserverStatistics& s, const UnitSystem& units) {
  return {{"corrections", s.corrections},
          {"weakened", s.weakened},
          {"largest_correction", s.largest},
          {"largest_correction_mm", units.to_mm(s.largest)}};
}

}  // namespace

void write_summary(const Simulation& simulation, const RunFacts& facts) {
  const RunPlan& plan = simulation.plan();
  Json json{{"case", facts.case_name}, {"title", facts.title}, {"case_file", facts.case_file}};
  json["units"] = {{"system", plan.units.name()},
                   {"length", plan.units.symbol(dimension::length)},
                   {"pressure", plan.units.symbol(dimension::pressure)},
                   {"flow", plan.units.symbol(dimension::flow)}};
  json["steps"] = plan.last_step;
  json["resumed_at_step"] = plan.resume ? Json(simulation.first_step()) : Json(nullptr);
  json["dt"] = plan.dt;
  json["time"] = {{"start", plan.start}, {"end", plan.time_at(plan.last_step)}};
  add_costs(json, facts, simulation.statistics(), static_cast<double>(plan.last_step - simulation.first_step()));
  json["coupling_method"] = facts.method;
  add_results(json, simulation);
  if (const Observer* observer = simulation.observer())
    json["observer"] = observer_facts(observer->statistics(), plan.units);
  json["notices"] = facts.notices;
  for (const auto& process : facts.processes) json["versions"][process.name] = process.program;
  json["effective_case"] = Json::parse(facts.effective_case);
  std::ofstream file(plan.output / "summary.json");
  file << json.dump(2) << std::endl;
  if (!file) throw run_error("{} cannot be written", (plan.output / "summary.json").string());
}

std::string merged_json(const std::vector<std::string>& texts) {
  Json all = Json::object();
  for (const std::string& text : texts) {
    const Json one = Json::parse(text, nullptr, false);
    if (one.is_object()) all.update(one);
  }
  return all.dump();
}

}  // namespace tether
