#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "common/config/echo.hpp"
#include "common/io/vtu_writer.hpp"
#include "common/mesh/surface.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/check.hpp"
#include "vessel/mesh_case.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace load_mesh_test {

const std::string head = "name: x\nunits: cgs\ntime: {step: 1e-3, end: 1}\n";

MeshCase read_case(const TemporaryFolder& folder, const std::string& text) {
  CaseFile file(folder.file("case.yaml", head + text));
  MeshCase mesh;
  file.read("mesh", mesh);
  file.finish();
  return mesh;
}
VesselMesh load(const std::string& text, WallElement element = WallElement::prism) {
  const TemporaryFolder folder;
  return load_mesh(read_case(folder, text), UnitSystem::cgs(), element);
}
void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(MeshCase, SweptTubeWithRegions) {
  const VesselMesh tube = load(R"(mesh:
  source: swept
  swept:
    radius: 20 mm
    length: 10
    wall_thickness: 0.2
    regions:
      spine:    {angle: [150, 210]}
      vicinity: {angle: [105, 255]}
      opposite: {}
)");
  EXPECT_EQ(tube.fluid.points.cols(), 2037);
  EXPECT_EQ(tube.wall.prisms.size(), 24u * 20u * 4u);
  ASSERT_EQ(tube.wall.outside.size(), 3u);
  EXPECT_EQ(tube.wall.outside[2].name, "opposite");
  EXPECT_EQ(tube.wall.outside[0].triangles.size(), 160u);
  EXPECT_NEAR(mean_lumen_diameter(tube.fluid), 4, 0.06);
  EXPECT_EQ(load("mesh: {swept: {radius: 2, length: 10, wall_thickness: 0.2}}", WallElement::p1).wall.tetrahedra.size(),
            24u * 20u * 12u);
}

TEST(MeshCase, EffectiveCaseReadsBackToTheSameMesh) {
  const TemporaryFolder folder;
  const MeshCase first = read_case(folder,
                                   "mesh: {swept: {radius: 2, length: 5, around: 16, wall_thickness: 0.2, regions: {a: "
                                   "{position: [0, 0.5]}, b: {}}}}");
  Echo echo;
  MeshCase copy = first;
  echo.group("mesh", copy, {});
  const VesselMesh again = load_mesh(read_case(folder, echo.yaml()), UnitSystem::cgs(), WallElement::prism);
  const VesselMesh mesh = load_mesh(first, UnitSystem::cgs(), WallElement::prism);
  EXPECT_EQ(again.wall.points, mesh.wall.points);
  EXPECT_EQ(again.wall.outside[0].triangles, mesh.wall.outside[0].triangles);
}

TEST(MeshCase, ContoursInMillimetres) {
  const TemporaryFolder folder;
  std::string csv = "section, point, x, y, z\n";
  for (int section = 0; section < 3; ++section)
    for (int i = 0; i < 16; ++i) {
      const double a = 2 * std::numbers::pi * i / 16;
      csv += fmt::format("s{},{},{},{},{}\n", section, i, 10 * std::cos(a), 10 * std::sin(a), 20 * section);
    }
  folder.file("contours.csv", csv);
  const std::string text =
      "mesh: {swept: {contours: {file: contours.csv, unit: mm}, extend: {inlet: 20 mm, outlet: 1}, wall_thickness: "
      "0.15, around: 16, along: 14}}";
  const VesselMesh vessel = load_mesh(read_case(folder, text), UnitSystem::cgs(), WallElement::prism);
  EXPECT_NEAR(vessel.fluid.points.row(2).minCoeff(), -2, 1e-12);
  EXPECT_NEAR(vessel.fluid.points.row(2).maxCoeff(), 5, 1e-12);
  EXPECT_NEAR(mean_lumen_diameter(vessel.fluid), 2, 0.05);
  folder.file("contours.csv", csv + "s0,0,0,0,0\n");
  expect_part(message_of([&] { load_mesh(read_case(folder, text), UnitSystem::cgs(), WallElement::prism); }),
              "contours.csv:50: section s0 occurs in two places");
}

const std::string peer = std::filesystem::absolute("data/peer_tube").string();

std::string peer_case(const std::string& rest) {
  return "mesh:\n  source: files\n  files:\n    fluid: " + peer + "/fluid/mesh.vtu\n    interface: {file: " + peer +
         "/fluid/faces/interface.vtp}\n    inlets: {inlet: {file: " + peer +
         "/fluid/faces/inlet.vtp}}\n    outlets: {outlet: {file: " + peer + "/fluid/faces/outlet.vtp}}\n" + rest;
}

TEST(MeshCase, FilesWithTheirWall) {
  const std::string wall = "    wall: " + peer + "/solid/mesh.vtu\n    wall_interface: {file: " + peer +
                           "/solid/faces/interface.vtp}\n    outside: {all: {file: " + peer +
                           "/solid/faces/outside.vtp}}\n    rings: {inlet_ring: {file: " + peer +
                           "/solid/faces/inlet.vtp}, outlet_ring: {file: " + peer + "/solid/faces/outlet.vtp}}\n";
  EXPECT_EQ(load(peer_case(wall)).wall.prisms.size(), 1920u);
  EXPECT_EQ(load(peer_case(wall), WallElement::p1).wall.tetrahedra.size(), 5760u);
}

TEST(MeshCase, FilesWithAGrownWall) {
  const VesselMesh tube =
      load(peer_case("    grown_wall: {thickness: 0.2, layers: 3, regions: {spine: {angle: [150, 210]}, rest: {}}}\n"));
  EXPECT_EQ(tube.wall.prisms.size(), 2880u);
  EXPECT_EQ(tube.wall.outside[0].triangles.size(), 160u);
}

/// A tube's centreline beside the case, and more of the section `files`.
VesselMesh load_with_centreline(const std::string& more,
                                const std::string& rows = "tube,,0,0,0,20\ntube,,0,0,100,20\n") {
  const TemporaryFolder folder;
  folder.file("centreline.csv", "branch, parent, x [mm], y [mm], z [mm], radius [mm]\n" + rows);
  return load_mesh(read_case(folder, peer_case("    centreline: centreline.csv\n" + more)), UnitSystem::cgs(),
                   WallElement::prism);
}

TEST(MeshCase, GeometricRegionsOfAGrownWall) {
  const VesselMesh tube = load_with_centreline(R"(    grown_wall: {fraction_of_radius: 0.1}
    regions:
      spine: {angle: [-30, 30], angle_origin: [-1, 0, 0]}
      ends: {along: [1, 9], divide: 2}
      rest: {}
)");
  ASSERT_EQ(tube.wall.outside.size(), 4u);
  EXPECT_EQ(tube.wall.outside[1].name, "ends_1");
  const double whole = area_of(tube.wall.points, tube.wall.outside[0]) * 6;
  EXPECT_NEAR(whole, 2 * std::numbers::pi * 2.2 * 10, 0.02 * whole);
  for (const std::size_t half : {1u, 2u})
    EXPECT_NEAR(area_of(tube.wall.points, tube.wall.outside[half]), whole * 5 / 6 * 0.4, 0.01 * whole) << half;
}

TEST(MeshCase, RegionsOfAVesselAreNamedWithTheirMistakes) {
  const auto fault = [](const std::string& more) { return message_of([&] { load(peer_case(more)); }); };
  expect_part(fault("    grown_wall: {thickness: 0.2}\n    regions: {a: {branches: [aorta]}}\n"),
              "mesh.files.regions.a: branches, along, angle and divide refer to the centreline");
  expect_part(fault("    grown_wall: {thickness: 0.2, branches: {a: {thickness: 0.1}}}\n"), "centreline");
  expect_part(fault("    grown_wall: {thickness: 0.2}\n    outside: {a: {label: 1}}\n"), "is of a wall that is read");
  expect_part(fault("    grown_wall: {thickness: 0.2}\n    rings: {a: {label: 1}}\n"), "inlet_ring");
  expect_part(fault("    grown_wall: {thickness: 0.2, fraction_of_radius: 0.1}\n"), "give either thickness");
  expect_part(message_of([] {
                load_with_centreline(
                    "    grown_wall: {thickness: 0.2}\n    regions: {a: {line: arch, "
                    "along: [0, 1]}, rest: {}}\n");
              }),
              "mesh.files.regions.a: the centreline has no branch 'arch'; it has tube");
}

TEST(MeshCase, MistakesOfACentrelineAreNamedWithItsFile) {
  const auto fault = [](const std::string& rows) {
    return message_of([&] { load_with_centreline("    grown_wall: {fraction_of_radius: 0.1}\n", rows); });
  };
  expect_part(fault("tube,,0,0,0,20\ntube,,0,0,100,-1\n"), "/centreline.csv:3: radius: -0.1: must be positive");
  expect_part(fault("tube,,0,0,0,20\ntube,,0,0,100,20\nb,tube,0,0,1,1\n"),
              "/centreline.csv:4: branch b: has no length: must have at least two points apart");
  expect_part(fault("tube,,0,0,0,20\ntube,,0,0,100,20\nb,tube,0,0,50,1\nb,tube,0,0,51,1\n"),
              "/centreline.csv: centreline b: lies within its parent's lumen all along");
}

TEST(MeshCase, SizesThatNoVesselHasAreNamedWithTheirLine) {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& swept) {
    CaseFile file(folder.file("case.yaml", head + "mesh:\n  source: swept\n  swept: " + swept + "\n"));
    MeshCase mesh;
    file.read("mesh", mesh);
    file.finish();
    return message_of([&] { load_mesh(mesh, file, WallElement::prism); });
  };
  EXPECT_TRUE(fault("{radius: 2, length: 10, wall_thickness: 100}")
                  .starts_with((folder / "case.yaml:4: mesh: the wall is ").string()))
      << fault("{radius: 2, length: 10, wall_thickness: 100}");
  EXPECT_TRUE(fault("{radius: 200, length: 1000, wall_thickness: 10}")
                  .starts_with((folder / "case.yaml:4: mesh: the lumen's mean diameter ").string()));
}

/// A vessel bent by a right angle, in files.
TEST(MeshCase, AnglesAboutAStraightLineAreRefusedInABend) {
  const TemporaryFolder folder;
  SweepSettings bend;
  for (int i = 0; i <= 6; ++i) {
    const double turn = std::numbers::pi / 2 * i / 6;
    const Vec3 out(std::cos(turn), 0, std::sin(turn));
    Points circle(3, 24);
    for (int j = 0; j < 24; ++j) {
      const double a = 2 * std::numbers::pi * j / 24;
      circle.col(j) = (5 + std::cos(a)) * out + std::sin(a) * Vec3::UnitY();
    }
    bend.sections.push_back(circle);
  }
  bend.wall_thickness = 0.2;
  bend.along = 12;
  bend.disc.around = 24;
  bend.angle_origin = Vec3::UnitY();
  const FluidMesh fluid = sweep(bend).fluid;
  write_vtu(folder / "lumen.vtu", fluid.points, cells_of(fluid), {});
  write_vtu(folder / "wall.vtu", fluid.points, {.triangles = fluid.interface}, {});
  write_vtu(folder / "in.vtu", fluid.points, {.triangles = fluid.inlets[0].triangles}, {});
  write_vtu(folder / "out.vtu", fluid.points, {.triangles = fluid.outlets[0].triangles}, {});
  folder.file("case.yaml", head + R"(mesh:
  source: files
  files:
    fluid: lumen.vtu
    interface: {file: wall.vtu}
    inlets: {in: {file: in.vtu}}
    outlets: {out: {file: out.vtu}}
    grown_wall:
      thickness: 0.1
      regions: {spine: {angle: [0, 90]}, rest: {}}
)");
  CaseFile file(folder / "case.yaml");
  MeshCase mesh;
  file.read("mesh", mesh);
  file.finish();
  expect_part(
      message_of([&] { load_mesh(mesh, file, WallElement::prism); }),
      "case.yaml:13: mesh.files.grown_wall.regions: angles are about the straight line from inlet to outlet, but "
      "the vessel's axis is ");
}

TEST(MeshCase, SimVascularFolders) {
  const TemporaryFolder folder;
  for (const std::string part : {"fluid", "solid"}) {
    std::filesystem::create_directories(folder / part);
    std::filesystem::copy(peer + "/" + part + "/faces", folder / (part + "/mesh-surfaces"));
    std::filesystem::copy(peer + "/" + part + "/mesh.vtu", folder / (part + "/mesh-complete.mesh.vtu"));
  }
  const auto text = [](const std::string& outlet) {
    return "mesh: {source: mesh_complete, mesh_complete: {fluid: fluid, interface: interface, inlets: {in: {face: "
           "inlet}}, outlets: {out: {face: " +
           outlet +
           "}}, wall: solid, wall_interface: interface, outside: {all: {face: outside}}, rings: {a: {face: inlet}, b: "
           "{face: outlet}}}}";
  };
  const VesselMesh tube = load_mesh(read_case(folder, text("outlet")), UnitSystem::cgs(), WallElement::prism);
  EXPECT_EQ(tube.fluid.outlets[0].name, "out");
  EXPECT_EQ(tube.wall.prisms.size(), 1920u);
  expect_part(message_of([&] { load_mesh(read_case(folder, text("outflow")), UnitSystem::cgs(), WallElement::prism); }),
              "outflow.vtp: does not exist; faces there: ");
  expect_part(message_of([&] { read_case(folder, text("../outlet")); }),
              "mesh.mesh_complete.outlets.out.face: ../outlet: must be the name of a file in mesh-surfaces");
}

TEST(MeshCase, MistakesAreNamedWithTheirLine) {
  expect_part(message_of([] { load("mesh: {swept: {radius: 2, wall_thickness: 0.2}}"); }),
              "give either radius and length, or contours");
  expect_part(message_of([] { load("mesh:\n  swept:\n    radius: 2\n    length: 5\n    wall_thickness: -0.2"); }),
              "case.yaml:8: mesh.swept.wall_thickness: -0.2 cm: must be positive");
  expect_part(message_of([] { load("mesh: {swept: {radius: 2, length: 9, wall_thickness: 0.2, around: 25}}"); }),
              "must be even");
  expect_part(message_of([] { load("mesh: {swept: {radius: 200, length: 900, wall_thickness: 20}}"); }),
              "must be 0.3 to 120 mm in units: cgs");
  expect_part(message_of([] { load("mesh: {swept: {radius: 2, length: 9, wall_thickness: 0.2}, files: {fluid: x}}"); }),
              "mesh.files");
  expect_part(message_of([] { load(peer_case("")); }), "give either the wall's mesh or grown_wall");
  expect_part(message_of([] { load(peer_case("    grown_wall: {thickness: 0.2}\n    inlet: {}\n")); }), "inlets");
}

/// Each within its range, all together beyond memory and time.
TEST(MeshCase, MoreNodesThanARunCanTakeAreRefused) {
  const TemporaryFolder folder;
  CaseFile file(folder.file("case.yaml", head + "mesh:\n  swept: {radius: 2, length: 10, wall_thickness: 0.2, around: "
                                                "1000, along: 10000, layers: 50}\n"));
  MeshCase mesh;
  file.read("mesh", mesh);
  file.finish();
  const std::string told = message_of([&] { load_mesh(mesh, file, WallElement::prism); });
  expect_part(told, "case.yaml:5: mesh.swept: around: 1000, along: 10000 and layers: 50 would make ");
  expect_part(told, " nodes: must make at most 2e+06");
}

TEST(MeshCase, LengthsThatNoVesselHasAreRefused) {
  for (const char* length : {"1e-20", "1e-7", "1e7", "1e15"})
    for (const char* field : {"radius", "length", "wall_thickness"}) {
      std::string text = "mesh:\n  swept:\n    radius: 2\n    length: 10\n    wall_thickness: 0.2\n";
      const std::size_t at = text.find(std::string(" ") + field) + 3 + std::string(field).size();
      text.replace(at, text.find('\n', at) - at, length);
      expect_part(message_of([&] { load(text); }),
                  fmt::format("mesh.swept.{}: {}: must be at least 1e-6 and at most 1e6", field, length));
    }
  expect_part(
      message_of([] { load("mesh: {swept: {radius: 2, length: 9, wall_thickness: 0.2, extend: {inlet: 1e15}}}"); }),
      "mesh.swept.extend.inlet: 1e15: must be at least 1e-6");
}

}  // namespace load_mesh_test
}  // namespace tether
