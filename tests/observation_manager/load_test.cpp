// Files of measurements as people have them, and what is said of bad ones.
#include <gtest/gtest.h>

#include <fmt/ranges.h>
#include <sys/stat.h>

#include <cmath>
#include <sstream>

#include "common/base/error.hpp"
#include "observation_manager/measurements/contour_file.hpp"
#include "observation_manager/measurements/observations.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "observation_manager/measurements/surface_files.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/observation_manager/lumens.hpp"

namespace tether::testing {
namespace load_test {

constexpr double pi = std::numbers::pi;

TriangleSurface vessel(double radius, double factor = 1) {
  return scaled(tube(16, 8, 4, [radius](double) { return radius; }), factor);
}

std::string stl(const TriangleSurface& surface) {
  std::string text = "solid s\n";
  for (const Triangle& t : surface.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int node : t)
      text +=
          fmt::format("vertex {} {} {}\n", surface.points(0, node), surface.points(1, node), surface.points(2, node));
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

std::string ply(const TriangleSurface& surface) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "{}\n"
      "property list uchar int vertex_indices\nend_header\n",
      surface.points.cols(), surface.triangles.size());
  for (const auto& x : surface.points.colwise()) text += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
  for (const auto& [a, b, c] : surface.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

std::string vtp(const TriangleSurface& surface) {
  std::string points, cells, offsets;
  for (const auto& x : surface.points.colwise()) points += fmt::format("{} {} {} ", x[0], x[1], x[2]);
  for (const auto& [a, b, c] : surface.triangles) {
    cells += fmt::format("{} {} {} ", a, b, c);
    offsets += fmt::format("{} ", 3 * (std::count(offsets.begin(), offsets.end(), ' ') + 1));
  }
  return fmt::format(
      "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData><Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\"><Points>"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{}</DataArray></Points><Polys>"
      "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">{}</DataArray>"
      "<DataArray type=\"Int32\" Name=\"offsets\" "
      "format=\"ascii\">{}</DataArray></Polys></Piece></PolyData></VTKFile>\n",
      surface.points.cols(), surface.triangles.size(), points, cells, offsets);
}

/// A contour about the z axis at height z [mm], as rows of the table.
std::string circle_rows(const std::string& slice, int frame, double time, double radius, double z, int points = 24) {
  std::string rows;
  for (int i = 0; i < points; ++i)
    rows += fmt::format("{},{},{},{:.6f},{:.6f},{}\n", slice, frame, time, radius * std::cos(2 * pi * i / points),
                        radius * std::sin(2 * pi * i / points), z);
  return rows;
}

/// The same farther along x [mm].
std::string moved_rows(const std::string& rows, double by) {
  std::istringstream lines(rows);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, ',');) cells.push_back(cell);
    cells[3] = fmt::format("{}", std::stod(cells[3]) + by);
    all += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return all;
}

constexpr const char* heading = "slice,frame,time [ms],x [mm],y [mm],z [mm]\n";

class Load : public ::testing::Test {
 protected:
  /// The measurements of a case in cgs whose lumen is a tube of radius 1 cm, from 0 to 0.8 s.
  Observations load(const std::string& observations) {
    folder.file("case.yaml", "name: tube\nunits: cgs\ntime: {step: 1e-2, end: 0.8}\nobservations:\n" + observations);
    CaseFile file(folder / "case.yaml");
    ObservationsCase given;
    file.read("observations", given);
    file.finish();
    return load_observations(given, model, file);
  }
  std::string message(const std::string& observations) {
    std::string text = message_of([&] { load(observations); });
    const std::string path = folder.path().string() + "/";
    for (std::size_t at = 0; (at = text.find(path)) != std::string::npos;) text.erase(at, path.size());
    return text;
  }
  double first_distance(const Observations& data, double time) {
    return data.observe(model.points, time).at(40).distance;
  }

  TemporaryFolder folder;
  LumenSurface model = lumen(vessel(1));
};

TEST_F(Load, ReadsASeriesByPatternInTheOrderOfNumbers) {
  folder.file("wall_2.stl", stl(vessel(1.1, 10)));
  folder.file("wall_10.stl", stl(vessel(1.3, 10)));
  folder.file("readme.txt", "");
  const Observations data =
      load("  surfaces: {ct: {folder: ., pattern: wall_*.stl, first_time: 0.1, interval: 0.2, unit: mm}}\n");
  EXPECT_NEAR(first_distance(data, 0.1), 0.1, 2e-3);
  EXPECT_NEAR(first_distance(data, 0.2), 0.2, 4e-3);
  EXPECT_EQ(data.notes().size(), 2U);  // the open ends of both
}

TEST_F(Load, ReadsSeriesFromATableAndFromParaView) {
  folder.file("a.vtp", vtp(vessel(1.1)));
  folder.file("b.ply", ply(vessel(1.2)));
  folder.file("frames.csv", "file,time [ms]\na.vtp,100\nb.ply,300\n");
  folder.file("frames.pvd",
              "<VTKFile type=\"Collection\">\n<Collection>\n<DataSet timestep=\"0.1\" file=\"a.vtp\"/>\n<DataSet "
              "timestep=\"0.3\" file=\"b.ply\"/>\n</Collection></VTKFile>\n");
  for (const std::string list : {"frames.csv", "frames.pvd"}) {
    const Observations data = load("  surfaces: {ct: {file: " + list + ", unit: cm, period: 0.8, time_shift: 0.05}}\n");
    EXPECT_NEAR(first_distance(data, 0.15), 0.1, 2e-3) << list;
    EXPECT_NEAR(first_distance(data, 0.25), 0.15, 4e-3) << list;
    EXPECT_NEAR(first_distance(data, 0.65), 0.15, 4e-3) << list;  // halfway to 0.95, which is the first again
  }
}

/// What its file holds would not count in what results depend on.
TEST_F(Load, RefusesNamesThatAreWrittenOtherwiseThanTheyRead) {
  folder.file("a_1.vtp", vtp(vessel(1.1)));
  folder.file("'b.vtp", vtp(vessel(1.1)));
  const auto series = [&](const std::string& name) {
    return folder.file("frames.pvd", "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=" + name +
                                         "/></Collection></VTKFile>\n");
  };
  const auto said = [&](const std::string& list) {
    return message("  surfaces: {ct: {file: " + list + ", unit: cm}}\n");
  };
  series("\"a&#95;1.vtp\"");
  EXPECT_NE(said("frames.pvd").find("a_1.vtp must be written as it is, in UTF-8, without quotes or &#...;"),
            std::string::npos)
      << said("frames.pvd");
  series("'a_1.vtp'");
  EXPECT_NEAR(first_distance(load("  surfaces: {ct: {file: frames.pvd, unit: cm}}\n"), 0), 0.1, 2e-3);
  folder.file("frames.csv", "file,time [s]\n'b.vtp,0\n");
  EXPECT_NE(said("frames.csv").find("must be written as it is"), std::string::npos) << said("frames.csv");
}

TEST_F(Load, TakesOneSurfaceForAllTimes) {
  folder.file("a.stl", stl(vessel(1.1)));
  EXPECT_NEAR(first_distance(load("  surfaces: {ct: {file: a.stl, unit: cm}}\n"), 17), 0.1, 2e-3);
}

TEST_F(Load, MasksRegionsAndBands) {
  folder.file("a.stl", stl(vessel(1.1)));
  model.from_inlet = model.points.row(2);
  model.region_names = {"spine", "rest"};
  for (std::size_t i = 0; i < model.region.size(); ++i)
    model.region[i] = model.points(1, static_cast<Eigen::Index>(i)) > 0.5 ? 0 : 1;
  const Observations data =
      load("  surfaces: {ct: {file: a.stl, unit: cm, masked_regions: [spine], inlet_band: 1.2}}\n");
  const auto counts = count_exclusions(data.observe(model.points, 0));
  EXPECT_EQ(counts[static_cast<std::size_t>(Exclusion::masked)], 5 * 9);
  EXPECT_EQ(counts[static_cast<std::size_t>(Exclusion::near_end)], 11 * 3);  // z = 0, 0.5, 1
  EXPECT_EQ(
      message("  surfaces: {ct: {file: a.stl, unit: cm, masked_regions: [spin]}}\n"),
      "case.yaml:5: observations.surfaces.ct.masked_regions: spin: the wall has no such region; it has: spine, rest");
  EXPECT_EQ(message("  surfaces: {ct: {file: a.stl, unit: cm, inlet_band: 9}}\n"),
            "case.yaml:5: observations.surfaces.ct: masked regions and bands leave no place of the lumen to observe");
}

TEST_F(Load, RefusesBadSurfaces) {
  folder.file("a.stl", stl(vessel(1.1)));
  folder.file("mm.stl", stl(vessel(1.1, 10)));
  folder.file("gone.csv", "file,time [s]\nc.stl,0\n");
  folder.file("back.csv", "file,time [s]\na.stl,0.2\na.stl,0.1\n");
  folder.file("long.csv", "file,time [s]\na.stl,0\na.stl,0.8\n");
  folder.file("late.csv", "file,time [s]\na.stl,1\na.stl,2\n");
  folder.file("unit.csv", "file,time [mm]\na.stl,1\n");
  folder.file("nounit.csv", "file,time\na.stl,1\n");
  TriangleSurface neighbour = vessel(1);
  neighbour.points.row(0).array() += 2.1;
  folder.file("beside.stl", stl(neighbour));
  const auto ct = [&](const std::string& fields) { return message("  surfaces: {ct: {" + fields + "}}\n"); };
  EXPECT_EQ(ct("file: gone.csv, unit: cm"), "gone.csv:2: c.stl does not exist");
  EXPECT_EQ(ct("file: back.csv, unit: cm"), "back.csv:3: the time 0.1 of a.stl does not come after 0.2");
  EXPECT_EQ(ct("file: long.csv, unit: cm, period: 0.8"),
            "long.csv:3: the time 0.8 of a.stl lies beyond one period of 0.8: it would be the first frame again");
  EXPECT_EQ(ct("file: late.csv, unit: cm"),
            "case.yaml:5: observations.surfaces.ct: its frames are from 1 to 2, the run is from 0 to 0.8: period or "
            "time_shift?");
  EXPECT_EQ(ct("file: unit.csv, unit: cm"),
            "unit.csv:2: column 'time': '1 mm': mm is no unit of this field, which is in s");
  EXPECT_EQ(ct("folder: ., pattern: x*.stl, first_time: 0, interval: 0.1, unit: cm"),
            ": holds no file whose name matches x*.stl");
  EXPECT_EQ(ct("file: a.stl"),
            "case.yaml:5: observations.surfaces.ct.unit: missing: must be given (of the files' coordinates)");
  EXPECT_EQ(
      ct("file: mm.stl, unit: cm"),
      "mm.stl: about 10 times larger than the model: is its unit mm, not cm? the data reach from (-11, -11, 0) to "
      "(11, 11, 40), the model from (-1, -1, 0) to (1, 1, 4). In another unit? Multiplied by 0.1 they would be about "
      "as large");
  EXPECT_EQ(ct("file: beside.stl, unit: cm").substr(0, 75),
            "beside.stl: does not overlap the model: 0 % of the places of the lumen that");
  EXPECT_EQ(ct("file: nounit.csv, unit: cm"),
            "nounit.csv:2: the unit of time must stand in its heading, as in time [ms]");
  EXPECT_EQ(ct("file: a.stl, unit: cm, held_out: [3]"),
            "case.yaml:5: observations.surfaces.ct.held_out: there is no frame 3; frames are numbered 0 to 0");
}

TEST_F(Load, RefusesWhatATableOfSurfacesNamesThatIsNoFile) {
  folder.file("a.stl", stl(vessel(1.1)));
  std::filesystem::create_directory(folder / "d.vtp");
  ASSERT_EQ(mkfifo((folder / "p.vtp").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder / "z.vtp");
  const auto said = [&](const std::string& rows) {
    folder.file("frames.csv", "file,time [s]\n" + rows);
    return message("  surfaces: {ct: {file: frames.csv, unit: cm}}\n");
  };
  EXPECT_EQ(said("a.stl,0\nd.vtp,0.1\n"), "frames.csv:3: d.vtp is a folder: must be a surface's file");
  EXPECT_EQ(said(".,0\n"), "frames.csv:2: . is a folder: must be a surface's file");
  EXPECT_EQ(said("p.vtp,0\n"), "frames.csv:2: p.vtp is a device or a pipe: must be a surface's file");
  EXPECT_EQ(said("z.vtp,0\n"), "frames.csv:2: z.vtp is a device or a pipe: must be a surface's file");
  EXPECT_EQ(said("a.stl,0\n,0.1\n"), "frames.csv:3: file: '': must be the name of a surface's file");
  std::string many;
  for (int i = 0; i < 5001; ++i) many += fmt::format("a.stl,{}\n", 1e-4 * i);
  EXPECT_EQ(said(many), "frames.csv: has 5001 surfaces: must be at most 5000");
  folder.file(
      "far.pvd",
      "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"1e305\" file=\"a.stl\"/></Collection></VTKFile>");
  EXPECT_EQ(message("  surfaces: {ct: {file: far.pvd, unit: cm}}\n"),
            "far.pvd: timestep: 1e+305: must be from -1e+20 to 1e+20");
}

/// Data that were displaced, turned about (0.1, 0, 1) and made too small read as the others do, once that is taken off.
TEST_F(Load, TakesKnownErrorsOff) {
  const std::string exact = "  surfaces: {ct: {file: exact.stl, unit: cm}}\n";
  folder.file("exact.stl", stl(vessel(1.1)));
  TriangleSurface wrong = vessel(1.05);
  const Vec3 middle(0.1, 0, 1), by(0.03, -0.02, 0.01);
  const Eigen::AngleAxisd turn(0.05, Vec3::UnitX());
  for (auto point : wrong.points.colwise()) point = turn * (point - middle) + middle + by;
  folder.file("wrong.stl", stl(wrong));
  // x' = R^-1 (x - by - middle) + middle: turned back about middle + by, then displaced by -by.
  const Observations right = load(exact),
                     mended = load(
                         "  surfaces: {ct: {file: wrong.stl, unit: cm, correction: {rotation: [-0.05, 0, 0], about: "
                         "[1.3 mm, -0.02, 1.01], displacement: [-0.03, 0.02, -0.01], outward: 0.05}}}\n");
  const std::vector<Sample> expected = right.observe(model.points, 0), found = mended.observe(model.points, 0);
  int compared = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (expected[i].weight > 0 && found[i].weight > 0) {
      EXPECT_NEAR(found[i].distance, expected[i].distance, 1e-3) << "chords of another radius";
      ++compared;
    }
  EXPECT_GT(compared, 90);
  EXPECT_EQ(mended.lumen[0]->notes()[0].text, "corrected: turned by 2.86 degrees");
  EXPECT_EQ(message("  surfaces: {ct: {file: wrong.stl, unit: cm, correction: {rotation: [0, 0, 3]}}}\n"),
            "case.yaml:5: observations.surfaces.ct.correction.rotation: must be below 45 degrees; it is in radians");
  EXPECT_EQ(
      message("  surfaces: {ct: {file: wrong.stl, unit: cm, correction: {outward: -6 mm}}}\n").substr(0, 108),
      "case.yaml:5: observations.surfaces.ct.correction.outward: -0.6 is more than half of the vessel's mean radius");
  EXPECT_NE(mended.content(), load("  surfaces: {ct: {file: wrong.stl, unit: cm}}\n").content());
}

TEST_F(Load, LeavesFramesOut) {
  for (const int i : {1, 2, 3}) folder.file(fmt::format("f_{}.stl", i), stl(vessel(1 + 0.1 * i)));
  const std::string ct = "  surfaces: {ct: {folder: ., pattern: f_*.stl, first_time: 0, interval: 0.2, unit: cm, ";
  const Observations data = load(ct + "left_out: [1], held_out: [2]}}\n");
  const std::vector<Frame> frames = data.lumen[0]->frames();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].label, 2) << "the others keep their numbers";
  EXPECT_TRUE(frames[1].held_out);
  EXPECT_DOUBLE_EQ(frames[1].time, 0.4);
  EXPECT_EQ(message(ct + "left_out: [3]}}\n"),
            "case.yaml:5: observations.surfaces.ct.left_out: there is no frame 3; frames are numbered 0 to 2");
  EXPECT_EQ(message(ct + "left_out: [0, 1, 2]}}\n"),
            "case.yaml:5: observations.surfaces.ct.left_out: of 3 frames one at least must be left to the model");
  folder.file("c.csv", heading + circle_rows("A", 5, 0, 11, 15) + circle_rows("A", 6, 200, 13, 15));
  const Observations contours = load("  contours: {mr: {file: c.csv, left_out: [5], correction: {outward: -1 mm}}}\n");
  ASSERT_EQ(contours.lumen[0]->frames().size(), 1U);
  EXPECT_EQ(contours.lumen[0]->frames()[0].label, 6);
  EXPECT_NEAR(contours.observe(model.points, 0.2)[3].distance, 0.2, 2e-2);
  EXPECT_EQ(message("  contours: {mr: {file: c.csv, left_out: [7]}}\n"),
            "c.csv: left_out: there is no frame 7; its frames are 5, 6");
}

TEST_F(Load, ReadsContoursWithTimesOfTheirOwn) {
  folder.file("c.csv", heading + circle_rows("A", 0, 0, 11, 15) + circle_rows("A", 1, 200, 13, 15) +
                           circle_rows("B", 0, 100, 12, 25) + circle_rows("B", 1, 400, 9, 25));
  const Observations data = load("  contours: {mr: {file: c.csv, samples: 20}}\n");
  const std::vector<Sample> samples = data.observe(model.points, 0.1);
  ASSERT_EQ(samples.size(), 40U);
  EXPECT_NEAR(samples[3].distance, 0.2, 2e-2);  // polygons of 16 and 24
  EXPECT_NEAR(samples[23].distance, 0.2, 2e-2);
  EXPECT_EQ(data.observe(model.points, 0.0)[23].excluded, Exclusion::no_frame);
  const Observations out = load("  contours: {mr: {file: c.csv, samples: 20, slices: [B], held_out: [1]}}\n");
  EXPECT_EQ(out.observe(model.points, 0.1).size(), 20U);
  EXPECT_TRUE(out.lumen[0]->frames()[1].held_out);
}

TEST_F(Load, ReadsTimesAsFractionsOfABeat) {
  folder.file("c.csv",
              "slice,frame,time,x,y,z\n" + circle_rows("A", 0, 0, 1.1, 1.5) + circle_rows("A", 1, 0.5, 1.3, 1.5));
  const Observations data = load("  contours: {mr: {file: c.csv, unit: cm, beat: 0.6}}\n");
  EXPECT_NEAR(data.lumen[0]->frames()[1].time, 0.3, 1e-15);
  EXPECT_NEAR(first_distance(data, 0.45), 0.2, 2e-2);
  EXPECT_NEAR(first_distance(data, 0.6), 0.1, 2e-2);
}

TEST_F(Load, RefusesBadContours) {
  const std::string good = circle_rows("A", 0, 0, 11, 15);
  const auto csv = [&](const std::string& rows, const std::string& fields = "") {
    folder.file("c.csv", rows);
    return message("  contours: {mr: {file: c.csv" + fields + "}}\n");
  };
  EXPECT_EQ(csv(heading + good), "accepted");
  EXPECT_EQ(csv("slice,frame,time [ms],x,y,z\n" + good),
            "c.csv: the unit of x is stated neither in its heading (x [mm]) nor in the case (unit)");
  EXPECT_EQ(csv(heading + good + circle_rows("B", 0, 0, 11, 25) + good),
            "c.csv:50: slice A, frame 0 occurs in two places: the rows of a contour must stand together");
  for (const std::string frame : {"-1", "0.5", "99999999999999999999"})
    EXPECT_TRUE(
        csv(heading + good + "A," + frame + ",200,1,1,15\n").ends_with(": must be a whole number from 0 to 1000000"))
        << frame;
  EXPECT_EQ(csv(heading + good + "A,-1,200,1,1,15\n"), "c.csv:26: frame: -1: must be a whole number from 0 to 1000000");
  EXPECT_EQ(csv(heading + good + ",1,200,1,1,15\n"),
            "c.csv:26: slice: '': a name consists of letters, digits, spaces and _-.+=()%");
  EXPECT_EQ(csv(heading + good + "A,1,200,1,1,15\nA,1,300,1,2,15\n"),
            "c.csv:27: slice A, frame 1 has two times, 0.2 and 0.3");
  EXPECT_EQ(csv(heading + good + circle_rows("A", 1, 0, 12, 15)),
            "c.csv:26: the time 0 of slice A, frame 1 does not come after 0");
  EXPECT_EQ(csv(heading + good + "A,1,200,1,1,15\nA,1,200,1,2,15\n"),
            "c.csv:26: slice A, frame 1 has 2 different points: at least 3 are needed");
  EXPECT_EQ(csv(heading + good + "A,1,200,10,0,15\nA,1,200,0,10,15\nA,1,200,0,0,15\nA,1,200,10,10,15\n"),
            "c.csv:26: slice A, frame 1: the contour crosses itself");
  EXPECT_EQ(csv(heading + good + circle_rows("A", 1, 200, 11, 19)).substr(0, 63),
            "c.csv:2: slice A is not flat: its points lie up to 0.2 off a pl");
  EXPECT_EQ(
      csv(heading + circle_rows("A", 0, 0, 11, 90)),
      "c.csv: does not overlap the model: no slice cuts the model's lumen; the data reach from (-1.1, -1.1, 9) to "
      "(1.1, 1.1, 9), the model from (-1, -1, 0) to (1, 1, 4)");
  EXPECT_EQ(csv(heading + good + circle_rows("B", 0, 0, 11, 25), ", slices: [C]"),
            "c.csv: has no slice C; it has A, B");
  EXPECT_EQ(csv(heading + good + circle_rows("A", 3, 200, 11, 15), ", held_out: [1]"),
            "c.csv: held_out: there is no frame 1; its frames are 0, 3");
  EXPECT_EQ(csv("slice,frame,time,x [mm],y [mm],z [mm]\n" + good),
            "c.csv:2: the unit of time must stand in its heading, as in time [ms]");
  EXPECT_EQ(
      csv(heading + good, ", beat: 0.8"),
      "c.csv:2: time is in ms, but with beat in the case times are fractions of a beat: give period instead of beat, "
      "or leave out the unit");
  EXPECT_EQ(csv("slice,frame,time [ms],x [mm],y [mm],z [mm],closed\nA,0,0,1,1,15,7\n"),
            "c.csv:2: closed: 7: must be 1 (closed) or 0 (a line with two ends)");
  EXPECT_EQ(csv(heading + std::string("A,0,0,1,1,15\nA,0,0,2,2,15\nA,0,0,3,3,15\n")).substr(0, 17),
            "c.csv:2: slice A:");
  EXPECT_EQ(csv(heading + circle_rows("A", 0, 0, 1, 15)).substr(0, 120),
            "c.csv: does not overlap the model: its contours are about 10 times smaller than the model: in another "
            "unit?; the "
            "data re");
  folder.file("beside.csv", heading + moved_rows(good, 21));
  EXPECT_EQ(message("  contours: {mr: {file: beside.csv}}\n").substr(0, 44),
            "beside.csv: does not overlap the model: 41 %");
  EXPECT_EQ(csv(heading + good + "A,0,0,1,x,15\n"), "c.csv:26: y: 'x' is not a number");
}

TEST_F(Load, RefusesAnArcThatCountsAsClosed) {
  std::string half = circle_rows("A", 0, 0, 11, 15);
  for (int rows = 0; rows < 12; ++rows) half.erase(half.rfind('A'));
  folder.file("c.csv", heading + half);
  EXPECT_EQ(
      message("  contours: {mr: {file: c.csv}}\n"),
      "c.csv:2: slice A, frame 0: counts as closed, but its ends are 2.18 apart, and no two other neighbours more "
      "than 0.287: is it a line with two ends (column closed: 0)?");
}

TEST_F(Load, NotesAContourFarFromTheModel) {
  folder.file("c.csv", heading + circle_rows("A", 0, 0, 11, 15) + moved_rows(circle_rows("A", 1, 200, 11, 15), 60) +
                           circle_rows("A", 2, 400, 11, 15));
  const std::vector<std::string> notes = load("  contours: {mr: {file: c.csv}}\n").notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].substr(0, 76), "mr: slice A at 0.2: only 0 % of the places of the lumen that it faces lie wi");
}

/// Of the lumen's nodes at the border of a surface, rounding decides whether they face it: the shares' last digits.
TEST_F(Load, RefusesAWallForALumenAndNotesAPart) {
  TriangleSurface wall = vessel(1.1);
  for (Triangle& t : wall.triangles) std::swap(t[0], t[1]);
  const TriangleSurface outer = vessel(1.3);
  const auto nodes = static_cast<int>(wall.points.cols());
  Points both(3, 2 * nodes);
  both << wall.points, outer.points;
  wall.points = both;
  for (const Triangle& t : outer.triangles) wall.triangles.push_back({t[0] + nodes, t[1] + nodes, t[2] + nodes});
  for (const int first : {0, 8})  // closed at both ends: 16 around, rows of 9
    for (int i = 0; i < 16; ++i) {
      const int a = 9 * i + first, b = 9 * ((i + 1) % 16) + first;
      if (first == 8) wall.triangles.insert(wall.triangles.end(), {{b, a, nodes + a}, {b, nodes + a, nodes + b}});
      if (first == 0) wall.triangles.insert(wall.triangles.end(), {{a, b, nodes + a}, {nodes + a, b, nodes + b}});
    }
  folder.file("wall.stl", stl(wall));
  const std::string of_wall = message("  surfaces: {ct: {file: wall.stl, unit: cm}}\n");
  EXPECT_TRUE(of_wall.starts_with("wall.stl: its normals look against those of the model's lumen at 9")) << of_wall;
  EXPECT_TRUE(
      of_wall.ends_with(" % of the places that it faces: is it the surface of the wall, and not of the lumen alone?"))
      << of_wall;
  folder.file("part.stl", stl(tube(16, 8, 1.2, [](double) { return 1.1; })));
  const std::vector<std::string> notes = load("  surfaces: {ct: {file: part.stl, unit: cm}}\n").notes();
  EXPECT_EQ(notes.back().substr(0, 21), "ct: part.stl: faces 2") << notes.back();
}

TEST_F(Load, NotesASliceFarFromTheModel) {
  folder.file("c.csv", heading + circle_rows("A", 0, 0, 11, 15) + moved_rows(circle_rows("B", 0, 0, 11, 25), 80));
  const std::vector<std::string> notes = load("  contours: {mr: {file: c.csv}}\n").notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].substr(0, 83),
            "mr: slice B: at most 0 % of the places of the lumen that it faces lie within 0.981 ");
}

/// As voxels show a vessel that ends with the image.
TEST_F(Load, FlatEndsOfASegmentationAreNoWall) {
  TriangleSurface closed = vessel(1.1);
  const LumenSurface as_lumen = lumen(closed);
  closed = closed_by_fans(as_lumen);
  folder.file("a.stl", stl(closed));
  const Observations data = load("  surfaces: {ct: {file: a.stl, unit: cm}}\n");
  EXPECT_EQ(data.notes(), std::vector<std::string>{
                              "ct: a.stl: 2 flat ends with 32 triangles at the model's open ends are no wall, and "
                              "left out; beside them nothing is observed"});
  int observed = 0;
  for (const Sample& sample : data.observe(model.points, 0)) {
    const double z = sample.position[2];
    EXPECT_TRUE(sample.excluded == Exclusion::none || (sample.excluded == Exclusion::rim && (z == 0 || z == 4))) << z;
    if (sample.excluded != Exclusion::none) continue;
    EXPECT_NEAR(sample.distance, 0.1, 3e-3) << z;
    ++observed;
  }
  EXPECT_GT(observed, model.points.cols() / 2);
}

TEST_F(Load, CountsVelocitiesOutsideTheLumen) {
  const std::string heading = "time [s], x [cm], y [cm], z [cm], vx [cm/s], vy [cm/s], vz [cm/s]\n";
  const std::string pc = "  velocities: {pc: {file: v.csv}}\n";
  folder.file("v.csv", heading + "0,0,0,1,1,1,1\n0,0.5,0,3.9,1,1,1\n");
  EXPECT_TRUE(load(pc).notes().empty());
  folder.file("v.csv", heading + "0,0,0,1,1,1,1\n0,0.95,0.95,1,1,1,1\n0,0,0,4.1,1,1,1\n");
  EXPECT_EQ(load(pc).notes(),
            std::vector<std::string>{"pc: 2 of 3 points lie outside the imaged lumen: nothing is observed "
                                     "there while the lumen does not reach them"});
  folder.file("v.csv", heading + "0,0.95,0.95,1,1,1,1\n");
  EXPECT_EQ(message(pc).substr(0, 112),
            "case.yaml:5: observations.velocities.pc: does not overlap the model: 1 of 1 points lie outside the imaged "
            "lumen;");
}

TEST_F(Load, LeavesOutRepeatedPointsAndSaysSo) {
  const std::string rows = circle_rows("A", 0, 0, 11, 15), last = rows.substr(rows.rfind('A'));
  folder.file("c.csv", heading + rows + last + last);
  EXPECT_EQ(load("  contours: {mr: {file: c.csv}}\n").notes(),
            std::vector<std::string>{"mr: 2 points that repeat the one before are left out"});
}

TEST_F(Load, ReadsTracesRelativeToTheImage) {
  folder.file("p.csv", "t [ms], p [mmHg]\n0, 80\n400, 120\n");
  const Observations data = load(
      "  traces: {p: {observable: fluid.outlet.pressure, quantity: pressure, noise: {deviation: 2 mmHg}, curve: {file: "
      "p.csv, time: t, value: p, period: 0.8}}}\nimage: {pressure: 80 mmHg}\n");
  ASSERT_EQ(data.traces.size(), 1U);
  EXPECT_EQ(data.traces[0].times, (std::vector<double>{0, 0.4}));
  EXPECT_NEAR(data.traces[0].values[0], 0, 1e-9);
  EXPECT_NEAR(data.traces[0].curve(1.0), 20 * 1333.22, 1e-6);
  EXPECT_NEAR(data.traces[0].noise.deviation, 2 * 1333.22, 1e-9);
}

TEST(SurfaceFiles, ComparesNamesByTheirNumbers) {
  EXPECT_TRUE(in_order_of_numbers("f_2.stl", "f_10.stl"));
  EXPECT_FALSE(in_order_of_numbers("f_10.stl", "f_2.stl"));
  EXPECT_TRUE(in_order_of_numbers("f_002.stl", "f_10.stl"));
  EXPECT_TRUE(in_order_of_numbers("a1b2", "a1b10"));
  EXPECT_FALSE(in_order_of_numbers("a", "a"));
}

TEST(SurfaceFiles, MatchPatternsInATimeThatTheirLengthBounds) {
  EXPECT_TRUE(matches("wall_07.stl", "wall_*.stl"));
  EXPECT_TRUE(matches("wall_07.stl", "wall_??.st?"));
  EXPECT_FALSE(matches("wall_07.stl.bak", "wall_*.stl"));
  EXPECT_TRUE(matches("wall_10.stl", "*_1?.*"));
  EXPECT_TRUE(matches("wall.stl.stl", "*.stl"));
  EXPECT_TRUE(matches("", "**"));
  EXPECT_FALSE(matches("wall_10.stl", "wall_?.stl"));
  EXPECT_FALSE(matches("", "?"));
  std::string pattern;
  for (int i = 0; i < 40; ++i) pattern += "*a";
  EXPECT_FALSE(matches(std::string(80, 'a') + "b", pattern)) << "tried in all ways it would take years";
  EXPECT_TRUE(matches(std::string(80, 'a'), pattern));
}

}  // namespace load_test
}  // namespace tether::testing
