// What a person does wrong, and the one message that the programs answer with: a valid case of two files, and in each
// test one mistake.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* valid_case = R"(name: tube
units: cgs
time: {step: 2e-3, end: 0.1}
mesh:
  source: swept
  swept:
    radius: 2
    length: 6
    wall_thickness: 0.2
    around: 12
    along: 6
    regions: {spine: {angle: [150, 210]}, rest: {}}
fluid:
  density: 1.06
  rheology: {type: newtonian, viscosity: 0.04}
  inlets:
    inlet:
      flow: {file: inflow.csv, time: t, value: q, period: 0.9}
  outlets:
    outlet: {type: windkessel, proximal_resistance: 150, distal_resistance: 1850, compliance: 1.5e-3}
solid:
  density: 1.2
  material: {type: neo_hookean, young: 4e6, poisson: 0.45}
  support:
    regions:
      spine: {stiffness: 1e6}
)";

constexpr const char* swept_mesh = R"(  source: swept
  swept:
    radius: 2
    length: 6
    wall_thickness: 0.2
    around: 12
    along: 6
    regions: {spine: {angle: [150, 210]}, rest: {}}
)";

constexpr const char* mesh_in_files = R"(  source: files
  files:
    fluid: PEER/fluid/mesh.vtu
    interface: {file: PEER/fluid/faces/interface.vtp}
    inlets: {inlet: {file: PEER/fluid/faces/inlet.vtp}}
    outlets: {outlet: {file: PEER/fluid/faces/outlet.vtp}}
    wall: PEER/solid/mesh.vtu
    wall_interface: {file: PEER/solid/faces/interface.vtp}
    outside: {spine: {file: PEER/solid/faces/outside_spine.vtp}, a: {file: PEER/solid/faces/outside_vicinity_a.vtp},
              b: {file: PEER/solid/faces/outside_vicinity_b.vtp}, o: {file: PEER/solid/faces/outside_opposite.vtp}}
    rings: {inlet_ring: {file: PEER/solid/faces/inlet.vtp}, outlet_ring: {file: PEER/solid/faces/outlet.vtp}}
)";

constexpr const char* valid_curve = "t [s], q [ml/s]\n0, 0\n0.1, 100\n0.5, 20\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; !from.empty() && (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Where the mistake is: in the case, in its curve, or in the case that takes its mesh from files.
enum class In { the_case, the_curve, mesh_in_files };

struct Mistake {
  const char* name;
  In where;
  const char *from, *to, *message;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

class BadInput : public ::testing::TestWithParam<Mistake> {};

/// `text`, with the mistake if it belongs there.
std::string spoilt(const std::string& text, const Mistake& mistake, In where) {
  if (mistake.where != where) return text;
  const std::string changed = replaced(text, mistake.from, mistake.to);
  EXPECT_NE(changed, text) << "the mistake was not made";
  return changed;
}

/// The case and its curve in a folder of their own, with the mistake.
fs::path written(const Mistake& mistake) {
  const fs::path folder = test_folder() / mistake.name;
  fs::create_directories(folder);
  std::string text = spoilt(valid_case, mistake, In::the_case);
  if (mistake.where == In::mesh_in_files)
    text = replaced(text, swept_mesh, spoilt(mesh_in_files, mistake, In::mesh_in_files));
  std::ofstream(folder / "case.yaml") << replaced(text, "PEER", fs::absolute("data/peer_tube").string());
  std::ofstream(folder / "inflow.csv") << spoilt(valid_curve, mistake, In::the_curve);
  return folder;
}

ChildEnd validated(const fs::path& folder) {
  return capture({{FSI_MASTER, "--validate", (folder / "case.yaml").string()}, {}});
}

TEST(GoodInput, IsAccepted) {
  const Mistake another_title{"Swept", In::the_case, "name: tube", "name: tube\ntitle: A tube", ""};
  const Mistake another_name{"InFiles", In::mesh_in_files, " o: ", " opposite: ", ""};
  for (const Mistake& none : {another_title, another_name}) {
    const ChildEnd end = validated(written(none));
    EXPECT_EQ(end.errors, "") << none.name;
    EXPECT_EQ(end.exit_code, 0) << none.name;
  }
}

TEST_P(BadInput, IsAnsweredByOneMessage) {
  const fs::path folder = written(GetParam());
  const ChildEnd end = validated(folder);
  std::string message = end.errors;
  for (const std::string& known : {folder.string() + "/", fs::absolute("data/peer_tube/").string(),
                                   fs::path(FSI_MASTER).parent_path().string() + "/"})
    message = replaced(message, known, "");
  EXPECT_EQ(message, std::string(GetParam().message) + "\n");
  EXPECT_EQ(end.exit_code, 2);
}

const Mistake mistakes[] = {
    {"NotYaml", In::the_case, "solid:", "solid: [", "case.yaml:23: not YAML: end of sequence flow not found"},
    {"NoUtf8", In::the_case, "name: tube",
     "name: tube\ntitle: Stra\xDF"
     "e",
     "case.yaml:2: is not UTF-8; save the file in that encoding"},
    {"AliasBomb", In::the_case, "name: tube",
     "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\nb: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a, *a]\n"
     "c: &c [*b, *b, *b, *b, *b, *b, *b, *b, *b, *b]\nd: &d [*c, *c, *c, *c, *c, *c, *c, *c, *c, *c]\n"
     "e: &e [*d, *d, *d, *d, *d, *d, *d, *d, *d, *d]\nf: &f [*e, *e, *e, *e, *e, *e, *e, *e, *e, *e]",
     "case.yaml:1: more than 100000 values (aliases of aliases?)"},
    {"NameWithQuotes", In::the_case, "solid:\n", "output: {points: {\"it's\": [0, 0, 1]}}\nsolid:\n",
     "case.yaml:21: output.points.it's: a name consists of letters, digits, spaces and _-.+=()%"},
    {"NameThatWouldBeAScript", In::the_case, "solid:\n",
     "output: {points: {\"S'; system 'touch owned'; set title 'q\": [0, 0, 1]}}\nsolid:\n",
     "case.yaml:21: output.points.S'; system 'touch owned'; set title 'q: a name consists of letters, digits, spaces "
     "and "
     "_-.+=()%"},
    {"NameWithComma", In::the_case, "      spine: {stiffness", "      'a, b': {stiffness",
     "case.yaml:26: solid.support.regions.a, b: a name consists of letters, digits, spaces and _-.+=()%"},
    {"FieldGivenTwice", In::the_case, "units: cgs", "units: cgs\nunits: SI",
     "case.yaml:3: 'units' is given twice; first on line 2"},
    {"UnknownUnits", In::the_case, "units: cgs", "units: metric",
     "case.yaml:2: units: metric: must be one of cgs, SI, mm-g-s (unit system of all numbers that carry no unit of "
     "their own)"},
    {"UnknownField", In::the_case, "density: 1.06", "density: 1.06\n  viscosty: 0.04",
     "case.yaml:15: fluid.viscosty: unknown field; known here: density, rheology, mesh_motion, backflow_stabilisation, "
     "inlets, outlets, probes, sections"},
    {"UnknownSection", In::the_case, "solid:", "tissue: {}\nsolid:",
     "case.yaml:21: tissue: unknown section; known are base, name, title, units, time, image, initial_state, mesh, "
     "fluid, solid, coupling, observations, observer, identification, diagnosis, twin, output"},
    {"MissingField", In::the_case, "  density: 1.06\n", "",
     "case.yaml:13: fluid.density: missing: must be given in g/cm3 (density of the blood)"},
    {"NegativeStiffness", In::the_case, "stiffness: 1e6", "stiffness: -3",
     "case.yaml:26: solid.support.regions.spine.stiffness: -3 g/(cm2 s2): must not be negative (traction per "
     "displacement, in every direction)"},
    {"TooIncompressible", In::the_case, "poisson: 0.45", "poisson: 0.5",
     "case.yaml:23: solid.material.poisson: 0.5: must be at least 0 and at most 0.4999 (Poisson's ratio at small "
     "strain; 0.5 would be incompressible)"},
    {"RingMotionOfNoLengths", In::the_case, "  support:\n",
     "  rings: {inlet_ring: {type: driven, motion: {file: inflow.csv, time: t, x: q, y: q, z: q}}}\n  support:\n",
     "inflow.csv:2: column 'q': '1 ml/s': ml/s is no unit of this field, which is in cm"},
    {"WrongUnit", In::the_case, "compliance: 1.5e-3", "compliance: 1.5 mmHg",
     "case.yaml:20: fluid.outlets.outlet.compliance: '1.5 mmHg': mmHg is no unit of this field, which is in cm4 s2/g "
     "(volume the reservoir takes up per pressure)"},
    {"TextForNumber", In::the_case, "young: 4e6", "young: stiff",
     "case.yaml:23: solid.material.young: 'stiff' is not a number (Young's modulus at small strain)"},
    {"ListForNumber", In::the_case, "radius: 2", "radius: [2, 3]",
     "case.yaml:7: mesh.swept.radius: a list: must be a single value (of the lumen of a straight circular tube about "
     "the z axis)"},
    {"UnknownOutlet", In::the_case, "type: windkessel", "type: windkesel",
     "case.yaml:20: fluid.outlets.outlet.type: windkesel: must be one of windkessel, resistance, pressure; did you "
     "mean 'windkessel'? (what lies beyond this outlet)"},
    {"ParameterOfAnotherType", In::the_case, "type: windkessel", "type: resistance",
     "case.yaml:20: fluid.outlets.outlet.resistance: missing: must be given in g/(cm4 s) (pressure per "
     "flow)\ncase.yaml:20: fluid.outlets.outlet.proximal_resistance: only with 'type: windkessel'; here type is "
     "'resistance'\ncase.yaml:20: fluid.outlets.outlet.distal_resistance: only with 'type: windkessel'; here type is "
     "'resistance'\ncase.yaml:20: fluid.outlets.outlet.compliance: only with 'type: windkessel'; here type is "
     "'resistance'"},
    {"EndBeforeStart", In::the_case, "end: 0.1", "end: -0.1", "case.yaml:3: time.end: -0.1: must be after time.start"},
    {"ClockWithoutDigits", In::the_case, "end: 0.1", "start: 1e15, end: 1000000000000001",
     "case.yaml:3: time.start: 1e15: must be within 1e9 steps of 0: farther off the clock has not the digits for a "
     "step"},
    {"MoreStepsThanCanBeCounted", In::the_case, "end: 0.1", "end: 1e9",
     "case.yaml:3: time.step: 2e-3: must not make more than 1e9 steps of the run"},
    {"FormulaThatSetsAValue", In::the_case, "solid:\n",
     "solid:\n  effects: {e: {type: expression, normal: \"k=3\", parameters: {k: {value: 1}}}}\n",
     "case.yaml:22: solid.effects.e: \"k=3\": a formula cannot set a value: two of them are compared by =="},
    {"FormulaWithoutAValue", In::the_case, "solid:\n", "solid:\n  effects: {e: {type: expression, normal: \"1/0\"}}\n",
     "case.yaml:22: solid.effects.e: \"1/0\": is not a finite number"},
    {"FormulaThatIsNeverFinite", In::the_case, "solid:\n",
     "solid:\n  effects: {e: {type: expression, normal: \"1/0*un\"}}\n",
     "case.yaml:22: solid.effects.e: \"1/0*un\": is not a finite number, whatever its variables are"},
    {"FormulaWithADecimalComma", In::the_case, "solid:\n",
     "solid:\n  effects: {e: {type: expression, normal: \"-0,5*un\"}}\n",
     "case.yaml:22: solid.effects.e: \"-0,5*un\": numbers have points (0.5), and a formula is one, not a list"},
    {"FormulaWithAList", In::the_case, "solid:\n", "solid:\n  effects: {e: {type: expression, normal: \"(1,2)*un\"}}\n",
     "case.yaml:22: solid.effects.e: \"(1,2)*un\": numbers have points (0.5), and a formula is one, not a list"},
    {"TitleThatMovesTheCursor", In::the_case, "name: tube", "name: tube\ntitle: \"a\\e[2J\"",
     "case.yaml:2: title: a?[2J: must not hold control characters"},
    {"RegionNotOfTheMesh", In::the_case, "      spine: {stiffness", "      spin: {stiffness",
     "case.yaml:26: solid.support.regions.spin: the wall has no such part; it has: spine, rest"},
    {"OutletNotOfTheMesh", In::the_case, "    outlet: {", "    iliac: {",
     "case.yaml:19: fluid.outlets: nothing is said of \"outlet\", which the mesh has"},
    {"NoSuchFile", In::the_case, "file: inflow.csv", "file: inflw.csv",
     "case.yaml:18: fluid.inlets.inlet.flow.file: inflw.csv: no such file or folder: inflw.csv (comma-separated table "
     "whose first line names the columns)"},
    {"NoSuchProgram", In::the_case, "solid:\n", "coupling: {programs: {solid: my_solver}}\nsolid:\n",
     "case.yaml:21: coupling.programs.solid: my_solver does not exist (a file of your own: ./my_solver)"},
    {"OuterWallWithoutRegion", In::the_case, ", rest: {}", "",
     "case.yaml:12: mesh.swept.regions: no region holds the outer wall at angle 20.0 degrees, position 0.06: end the "
     "list with a region without limits"},
    {"VesselOf20Metres", In::the_case, "radius: 2\n    length: 6\n    wall_thickness: 0.2",
     "radius: 2000\n    length: 6000\n    wall_thickness: 200",
     "case.yaml:4: mesh: the lumen's mean diameter is 3864 cm = 3.864e+04 mm: must be 0.3 to 120 mm in units: cgs. "
     "Coordinates in "
     "another unit? Multiplied by 0.001 it would be 38.6 mm"},
    {"NegativeThickness", In::the_case, "wall_thickness: 0.2", "wall_thickness: -0.2",
     "case.yaml:9: mesh.swept.wall_thickness: -0.2 cm: must be positive (of the imaged wall)"},
    {"WallThickerThanLumen", In::the_case, "wall_thickness: 0.2", "wall_thickness: 3",
     "case.yaml:4: mesh: the wall is 2.898 cm thick on average, the lumen 3.864 cm wide: must be 0.001 to 0.5 of it"},
    {"NoSuchColumn", In::the_case, "value: q", "value: flow",
     "case.yaml:18: fluid.inlets.inlet.flow.value: flow: inflow.csv has no column 'flow'; its columns are t, q"},
    {"CellIsNoNumber", In::the_curve, "100", "much", "inflow.csv:3: q: 'much' is not a number"},
    {"CellIsMissing", In::the_curve, "0.1, 100", "0.1", "inflow.csv:3: cells in this row: 1, columns: 2"},
    {"TimesGoBack", In::the_curve, "0.5", "0.05", "inflow.csv:4: the time 0.05 does not come after 0.1"},
    {"NotANumberInCurve", In::the_curve, "100", "nan", "inflow.csv:3: q: 'nan' is not a number"},
    {"EmptyCurve", In::the_curve, "0, 0\n0.1, 100\n0.5, 20\n", "", "inflow.csv: has no rows"},
    {"CurveThatDoesNotClose", In::the_case, "period: 0.9", "period: 0.5",
     "inflow.csv:4: the value 20 is a period of 0.5 after the first one, 0: both are of one phase"},
    {"EmptyRegion", In::the_case, "[150, 210]", "[150, 150]",
     "case.yaml:12: mesh.swept.regions: spine holds no triangle of the outer wall: its limits are too narrow for this "
     "mesh, or an earlier region takes all of it"},
    {"CurveLongerThanPeriod", In::the_case, "period: 0.9", "period: 0.4",
     "inflow.csv:4: the time 0.5 lies beyond one period of 0.4"},
    {"CurveInWrongUnit", In::the_curve, "ml/s", "mmHg",
     "inflow.csv:2: column 'q': '1 mmHg': mmHg is no unit of this field, which is in cm3/s"},
    {"MeshIsNoMesh", In::mesh_in_files, "fluid: PEER/fluid/mesh.vtu", "fluid: PEER/README.md",
     "README.md: unknown kind of mesh file: must be .vtu, .vtp, .vtk, .ply, .msh, .stl or .obj"},
    {"MeshFileIsMissing", In::mesh_in_files, "fluid: PEER/fluid/mesh.vtu", "fluid: lumen.vtu",
     "case.yaml:7: mesh.files.fluid: lumen.vtu: no such file or folder: lumen.vtu (volume mesh of the lumen: .vtu, "
     ".vtk or .msh)"},
    {"FaceOfAnotherMesh", In::mesh_in_files, "fluid/faces/interface", "solid/faces/outside_spine",
     "case.yaml:8: mesh.files.interface: solid/faces/outside_spine.vtp: its node 0 at (-1.90526, 1.1, 0) is no node of "
     "fluid/mesh.vtu: the one of the "
     "same GlobalNodeID lies 1.26 away (at most 0.0001)"},
    {"LabelOfAFaceWithoutLabels", In::mesh_in_files, "fluid/faces/inlet.vtp}", "fluid/faces/inlet.vtp, label: 77}",
     "case.yaml:9: mesh.files.inlets.inlet: fluid/faces/inlet.vtp: has no array \"ModelFaceID\" on triangles; arrays "
     "in "
     "the file: GlobalElementID"},
    {"FaceForgotten", In::mesh_in_files, ",\n              b: {file: PEER/solid/faces/outside_vicinity_b.vtp}", "",
     "wall mesh: 80 of its 2112 boundary triangles carry no label, the first near (-1.404, 1.672, 0.1667): each must "
     "be in the interface, the outside or a ring"},
    {"FaceGivenTwice", In::mesh_in_files, "outside_vicinity_b", "outside_vicinity_a",
     "wall mesh: the boundary triangle near (-1.404, -1.672, 0.3333) is in two faces, a and b"},
    {"InterfaceIsThePartOfIt", In::mesh_in_files, "solid/faces/interface", "solid/faces/inlet",
     "interface: fluid node 91 at (2, 0, 0.5) has no partner on the wall solid/mesh.vtu: the nearest node lies 0.5 "
     "away (at most 0.0001)"},
    {"LumenForWall", In::mesh_in_files, "wall: PEER/solid", "wall: PEER/fluid",
     "case.yaml:12: mesh.files.wall_interface: solid/faces/interface.vtp: its node 24 at (2, 0, 0.5) is no node of "
     "fluid/mesh.vtu: the one of the same "
     "GlobalNodeID lies 2.55 away (at most 0.0001)"},
    {"MillimetresForCentimetres", In::mesh_in_files, "    wall:", "    scale: 10\n    wall:",
     "case.yaml:4: mesh: the lumen's mean diameter is 39.66 cm = 396.6 mm: must be 0.3 to 120 mm in units: cgs. "
     "Coordinates in "
     "another unit? Multiplied by 0.1 it would be 39.7 mm"},
};

INSTANTIATE_TEST_SUITE_P(All, BadInput, ::testing::ValuesIn(mistakes),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace tether
