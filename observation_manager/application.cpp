#include "observation_manager/application.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

#include "common/base/error.hpp"
#include "common/base/process.hpp"
#include "common/config/echo.hpp"
#include "common/observation/observed_case.hpp"
#include "common/protocol/run.hpp"
#include "observation_manager/server.hpp"

namespace tether {
namespace {

const std::string lumen_role = "solid_observation", flow_role = "fluid_observation";

std::string effective_section(ObservedCase& observed) {
  return echo_json("observations", observed.observations);
}

ObservationServer lumen_server(const CommandLine& command) {
  ObservedCase observed(command.case_file);
  if (!observed.observations.has_lumen_data())
    throw input_error("{}: names no surfaces or contours to compare the lumen with",
                      observed.file.where("observations"));
  const LumenSurface lumen = observed.lumen();
  return {load_observations(observed.observations, lumen, observed.file), lumen.points.cols(),
          effective_section(observed)};
}

FlowObservationServer flow_server(const CommandLine& command) {
  ObservedCase observed(command.case_file);
  FlowObservations data = load_flow_observations(observed.observations, observed.file);
  if (data.empty())
    throw input_error("{}: names no traces or velocities to compare the blood with",
                      observed.file.where("observations"));
  return {std::move(data), observed.file.units(), effective_section(observed)};
}

int run(const CommandLine& command) {
  if (command.role == flow_role)
    return protocol::run_partner<protocol::ToFlowObservation>(
        flow_role, [&command](const protocol::Welcome&) { return flow_server(command); });
  return protocol::run_partner<protocol::ToObservation>(
      lumen_role, [&command](const protocol::Welcome&) { return lumen_server(command); });
}

/// Throws InputError for a trace of an opening, probe or section that there is not. What a foreign fluid calls its
/// numbers is known only when it runs.
void check_observables(const ObservedCase& observed, const VesselMesh& vessel) {
  if (observed.file.has("coupling.programs.fluid")) return;
  std::vector<std::string> openings;
  for (const auto* patches : {&vessel.fluid.inlets, &vessel.fluid.outlets})
    for (const Patch& patch : *patches) openings.push_back(patch.name);
  for (const auto& [name, trace] : observed.observations.traces) {
    const std::string& observable = trace.observable;
    const auto first = observable.find('.'), last = observable.rfind('.');
    if (!observable.starts_with("fluid.") || first == last) continue;
    const std::string opening = observable.substr(first + 1, last - first - 1);
    if (std::find(openings.begin(), openings.end(), opening) != openings.end() ||
        observed.file.has("fluid.probes." + opening) || observed.file.has("fluid.sections." + opening))
      continue;
    throw input_error("{}: {}: the vessel has no opening, probe or section {}; its openings are {}",
                      observed.file.where("observations.traces." + name + ".observable"), observable, opening,
                      fmt::join(openings, ", "));
  }
}

void validate(const CommandLine& command) {
  const ObservedCase observed(command.case_file);
  const VesselMesh vessel = observed.vessel();
  const Observations observations = load_observations(observed.observations, lumen_of(vessel), observed.file);
  check_observables(observed, vessel);
  if (command.quiet) return;
  for (const std::string& note : observations.notes()) std::cout << note << "\n";
}

}  // namespace

Program observation_program() {
  prepare_process();
  return {
      .name = "observation_manager",
      .purpose =
          "The measurements of a case: how far the moving lumen is from segmented surfaces and contours, or the blood "
          "from measured pressures, flows and velocities. Started by a master.",
      .declare =
          [](Fields& fields) {
            MeshCase mesh;
            ObservationsCase observations;
            fields.group("mesh", mesh, meaning_of_section("mesh"));
            fields.group("observations", observations, meaning_of_section("observations"));
          },
      .validate = validate,
      .run = run,
      .roles = {lumen_role, flow_role}};
}

}  // namespace tether
