#include "fluid/application.hpp"

#include "common/base/process.hpp"
#include "common/config/echo.hpp"
#include "common/config/input_files.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/run.hpp"
#include "fluid/case.hpp"
#include "fluid/list_effects.hpp"
#include "fluid/server.hpp"
#include "vessel/mesh_case.hpp"

namespace tether::fluid {
namespace {

/// A case file and the sections of it that the blood needs.
struct BloodCase {
  explicit BloodCase(const std::filesystem::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("fluid", fluid);
    file.finish();
  }
  /// The lumen, checked against the case. The element of the wall makes no difference to it.
  FluidMesh lumen() const {
    FluidMesh result = load_mesh(mesh, file, WallElement::p1).fluid;
    check_against_mesh(fluid, result, file);
    return result;
  }
  CaseFile file;
  MeshCase mesh;
  FluidCase fluid;
};

std::string effective_sections(BloodCase& blood) {
  Echo echo;
  echo.group("mesh", blood.mesh, {});
  echo.group("fluid", blood.fluid, {});
  return echo.json();
}

FluidServer server_of(const std::filesystem::path& case_file, const protocol::Welcome& welcome, Team& team) {
  BloodCase blood(case_file);
  auto solver = std::make_unique<FluidSolver>(blood.lumen(), make_settings(blood.fluid, blood.file), team);
  return {std::move(solver), blood.file.units(), effective_sections(blood), welcome.output,
          held_curves(blood.fluid, blood.file)};
}

int run(const CommandLine& command) {
  return protocol::run_partner_together<protocol::ToObservedFluid>(
      "fluid",
      [&command](const protocol::Welcome& welcome, Team& team) { return server_of(command.case_file, welcome, team); },
      [&command] { return hash_files_read(command.case_file); });
}

}  // namespace

protocol::Here fluid_here() {
  return protocol::partner_here<protocol::ToObservedFluid>(
      [](const protocol::Program& program, const protocol::Welcome& welcome) {
        return server_of(program.arguments.front(), welcome, alone());
      });
}

Program fluid_program() {
  prepare_process();
  return {.name = "fluid",
          .purpose = "The blood: ALE Navier-Stokes with what lies beyond the outlets. Started by fsi_master.",
          .declare =
              [](Fields& fields) {
                MeshCase mesh;
                FluidCase fluid;
                fields.group("mesh", mesh, meaning_of_section("mesh"));
                fields.group("fluid", fluid, meaning_of_section("fluid"));
              },
          .validate =
              [](const CommandLine& command) {
                const BloodCase blood(command.case_file);
                blood.lumen();
                make_settings(blood.fluid, blood.file);
              },
          .list_effects =
              [](const CommandLine& command) {
                const BloodCase blood(command.case_file);
                return json_of(list_effects(blood.fluid, blood.file.units()));
              },
          .run = run};
}

}  // namespace tether::fluid
