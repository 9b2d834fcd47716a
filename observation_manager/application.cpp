#include "observation_manager/application.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>

#include "common/base/error.hpp"
#include "common/base/process.hpp"
#include "common/config/echo.hpp"
#include "common/config/input_files.hpp"
#include "common/protocol/run.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "observation_manager/server.hpp"

namespace tether {
namespace {

const std::string lumen_role = "solid_observation";

std::string effective_section(ObservedCase& observed) {
  return echo_json("observations", observed.observations);
}

ObservationServer lumen_server(const CommandLine& command) {
  ObservedCase observed(command.case_file);
  if (!observed.observations.has_distances())
    throw input_error("{}: names no surfaces or contours to compare the lumen with",
                      observed.file.where("observations"));
  const LumenSurface lumen = observed.lumen();
  return {load_observations(observed.observations, lumen, observed.file), lumen.points.cols(),
          effective_section(observed)};
}

int run(const CommandLine& command) {
  return protocol::run_partner<protocol::ToObservation>(
      lumen_role, [&command](const protocol::Welcome&) { return lumen_server(command); },
      [&command] { return hash_files_read(command.case_file); });
}

/// Throws InputError for a column of an opening, probe or section that there is not.
void check_column(const std::string& column, const std::string& where, const std::vector<std::string>& openings,
                  const CaseFile& file) {
  const auto first = column.find('.'), last = column.rfind('.');
  if (!column.starts_with("fluid.") || first == last) return;
  const std::string opening = column.substr(first + 1, last - first - 1);
  if (std::find(openings.begin(), openings.end(), opening) != openings.end() || file.has("fluid.probes." + opening) ||
      file.has("fluid.sections." + opening))
    return;
  throw input_error("{}: {}: the vessel has no opening, probe or section {}; its openings are {}", where, column,
                    opening, fmt::join(openings, ", "));
}

/// Of all that is compared with columns. What a foreign fluid calls its numbers is known only when it runs.
void check_columns(const Observations& data, const CaseFile& file, const VesselMesh& vessel) {
  if (file.has("coupling.programs.fluid")) return;
  std::vector<std::string> openings;
  for (const auto* patches : {&vessel.fluid.inlets, &vessel.fluid.outlets})
    for (const Patch& patch : *patches) openings.push_back(patch.name);
  for (const Measurement* source : data.all())
    for (const NeededColumn& column : source->columns())
      check_column(column.name, file.where(source->facts().field() + "." + column.field), openings, file);
}

void validate(const CommandLine& command) {
  const ObservedCase observed(command.case_file);
  const VesselMesh vessel = observed.vessel();
  const Observations observations = load_observations(observed.observations, lumen_of(vessel), observed.file);
  check_columns(observations, observed.file, vessel);
  if (command.quiet) return;
  for (const std::string& note : observations.notes()) std::cout << note << "\n";
}

}  // namespace

Program observation_program() {
  prepare_process();
  return {
      .name = "observation_manager",
      .purpose =
          "The measurements of a case: how far the moving lumen is from segmented surfaces and contours. Started by a "
          "master.",
      .declare =
          [](Fields& fields) {
            MeshCase mesh;
            ObservationsCase observations;
            fields.group("mesh", mesh, meaning_of_section("mesh"));
            fields.group("observations", observations, meaning_of_section("observations"));
          },
      .validate = validate,
      .run = run,
      .roles = {lumen_role}};
}

}  // namespace tether
