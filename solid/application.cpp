#include "solid/application.hpp"

#include "common/base/process.hpp"
#include "common/config/case_file.hpp"
#include "common/config/echo.hpp"
#include "common/config/followed_points.hpp"
#include "common/config/input_files.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/run.hpp"
#include "solid/case.hpp"
#include "solid/list_effects.hpp"
#include "solid/server.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {
namespace {

/// A case file and the sections of it that the wall needs.
struct WallCase {
  explicit WallCase(const std::filesystem::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("solid", solid);
    file.finish();
  }
  WallMesh wall() const {
    return load_mesh(mesh, file, solid.element == "p1" ? WallElement::p1 : WallElement::prism).wall;
  }
  CaseFile file;
  MeshCase mesh;
  SolidCase solid;
};

std::string effective_sections(WallCase& wall) {
  Echo echo;
  echo.group("mesh", wall.mesh, {});
  echo.group("solid", wall.solid, {});
  return echo.json();
}

SolidServer server_of(const std::filesystem::path& case_file, const protocol::Welcome& welcome, Team& team) {
  WallCase wall(case_file);
  return {prepare_wall(wall.solid, wall.wall(), wall.file, team), wall.file.units(), effective_sections(wall),
          welcome.output};
}

int run(const CommandLine& command) {
  return protocol::run_partner_together<protocol::ToObservedSolid>(
      "solid",
      [&command](const protocol::Welcome& welcome, Team& team) { return server_of(command.case_file, welcome, team); },
      [&command] { return hash_files_read(command.case_file); });
}

}  // namespace

protocol::Here solid_here() {
  return protocol::partner_here<protocol::ToObservedSolid>(
      [](const protocol::Program& program, const protocol::Welcome& welcome) {
        return server_of(program.arguments.front(), welcome, alone());
      });
}

Program solid_program() {
  prepare_process();
  return {.name = "solid",
          .purpose =
              "The vessel's wall: large-displacement hyperelastic, visco-elastically supported. Started by fsi_master.",
          .declare =
              [](Fields& fields) {
                MeshCase mesh;
                SolidCase solid;
                fields.group("mesh", mesh, meaning_of_section("mesh"));
                fields.group("solid", solid, meaning_of_section("solid"));
              },
          .validate =
              [](const CommandLine& command) {
                const WallCase wall(command.case_file);
                const WallMesh mesh = wall.wall();
                check_against_mesh(wall.solid, mesh, wall.file);
                check_motions(wall.solid, mesh, wall.file);
                check_followed(wall.file, mesh.points.leftCols(mesh.interface_nodes));
              },
          .list_effects =
              [](const CommandLine& command) {
                const WallCase wall(command.case_file);
                return json_of(list_effects(wall.solid, wall.wall(), wall.file.units()));
              },
          .run = run};
}

}  // namespace tether
