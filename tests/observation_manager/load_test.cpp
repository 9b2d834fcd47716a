// Surfaces, velocities and traces as people have them, and what is said of bad ones.
#include <sys/stat.h>

#include "observation_manager/measurements/surface_files.hpp"
#include "tests/io/work.hpp"
#include "tests/observation_manager/measured_files.hpp"

namespace tether::testing {
namespace load_test {

TEST_F(Load, ReadsASeriesByPatternInTheOrderOfNumbers) {
  folder.file("wall_2.stl", stl_text(vessel(1.1, 10)));
  folder.file("wall_10.stl", stl_text(vessel(1.3, 10)));
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

TEST_F(Load, ReadsASurfaceThatIsListedAgainOnce) {
  folder.file("a.stl", stl_text(vessel(1.1)));
  folder.file("b.stl", stl_text(vessel(1.2)));
  folder.file("frames.csv", "file,time [s]\na.stl,0.1\nb.stl,0.2\na.stl,0.3\nb.stl,0.4\n");
  const Observations data = load("  surfaces: {ct: {file: frames.csv, unit: cm, held_out: [3]}}\n");
  EXPECT_NEAR(first_distance(data, 0.1), first_distance(data, 0.3), 1e-15);
  EXPECT_NEAR(first_distance(data, 0.2), 0.2, 4e-3);
  EXPECT_TRUE(data.lumen[0]->frames()[3].held_out);

  std::string list = "file,time [s]\n";
  for (int i = 0; i < 5000; ++i) list += fmt::format("a.stl,{:.4f}\n", 1e-4 * i);
  folder.file("frames.csv", list);
  const Work work;
  load("  surfaces: {ct: {file: frames.csv, unit: cm}}\n");
  EXPECT_LT(work.seconds(), 4) << "to read it each time takes longer";
}

TEST_F(Load, ALongNameInATableIsToldWithoutItsMiddle) {
  folder.file("frames.csv", "file,time [s]\n" + std::string(900'000, 'x') + ",0\n");
  const std::string said = message("  surfaces: {ct: {file: frames.csv, unit: cm}}\n");
  EXPECT_NE(said.find("does not exist"), std::string::npos) << said.substr(0, 2000);
  EXPECT_LT(said.size(), 2000U);
  std::string rows = "file,time [s]\n";
  for (int i = 0; i < 5001; ++i) rows += ",0\n";
  folder.file("frames.csv", rows);
  EXPECT_EQ(message("  surfaces: {ct: {file: frames.csv, unit: cm}}\n"),
            "frames.csv: has 5001 surfaces: must be at most 5000");
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
  folder.file("a.stl", stl_text(vessel(1.1)));
  EXPECT_NEAR(first_distance(load("  surfaces: {ct: {file: a.stl, unit: cm}}\n"), 17), 0.1, 2e-3);
}

TEST_F(Load, MasksRegionsAndBands) {
  folder.file("a.stl", stl_text(vessel(1.1)));
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

TEST_F(Load, JoinsRegionsForWhichDistancesAreTold) {
  folder.file("a.stl", stl_text(vessel(1.1)));
  model.region_names = {"spine_1", "rest", "spine_2"};
  const std::string surface = "  surfaces: {ct: {file: a.stl, unit: cm}}\n";
  const ErrorRegions each = load(surface).regions;
  EXPECT_EQ(each.names, model.region_names);
  EXPECT_EQ(each.parts, (std::vector<int>{0, 1, 2}));
  const ErrorRegions joined = load(surface + "  regions: {spine: {of: [spine_1, spine_2]}}\n").regions;
  EXPECT_EQ(joined.names, std::vector<std::string>{"spine"});
  EXPECT_EQ(joined.parts, (std::vector<int>{0, -1, 0}));
  EXPECT_EQ(joined.of(-1), -1);
  EXPECT_EQ(
      message(surface + "  regions: {spine: {of: [spine_3]}}\n"),
      "case.yaml:6: observations.regions.spine.of: the wall has no region 'spine_3'; it has spine_1, rest, spine_2");
  EXPECT_EQ(message(surface + "  regions: {a: {of: [rest]}, b: {of: [rest]}}\n"),
            "case.yaml:6: observations.regions.b.of: rest belongs to a already");
}

TEST_F(Load, RefusesBadSurfaces) {
  folder.file("a.stl", stl_text(vessel(1.1)));
  folder.file("mm.stl", stl_text(vessel(1.1, 10)));
  folder.file("gone.csv", "file,time [s]\nc.stl,0\n");
  folder.file("back.csv", "file,time [s]\na.stl,0.2\na.stl,0.1\n");
  folder.file("long.csv", "file,time [s]\na.stl,0\na.stl,0.8\n");
  folder.file("late.csv", "file,time [s]\na.stl,1\na.stl,2\n");
  folder.file("unit.csv", "file,time [mm]\na.stl,1\n");
  folder.file("nounit.csv", "file,time\na.stl,1\n");
  TriangleSurface neighbour = vessel(1);
  neighbour.points.row(0).array() += 2.1;
  folder.file("beside.stl", stl_text(neighbour));
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
  folder.file("a.stl", stl_text(vessel(1.1)));
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
  folder.file("exact.stl", stl_text(vessel(1.1)));
  TriangleSurface wrong = vessel(1.05);
  const Vec3 middle(0.1, 0, 1), by(0.03, -0.02, 0.01);
  const Eigen::AngleAxisd turn(0.05, Vec3::UnitX());
  for (auto point : wrong.points.colwise()) point = turn * (point - middle) + middle + by;
  folder.file("wrong.stl", stl_text(wrong));
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
  for (const int i : {1, 2, 3}) folder.file(fmt::format("f_{}.stl", i), stl_text(vessel(1 + 0.1 * i)));
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
  folder.file("wall.stl", stl_text(wall));
  const std::string of_wall = message("  surfaces: {ct: {file: wall.stl, unit: cm}}\n");
  EXPECT_TRUE(of_wall.starts_with("wall.stl: its normals look against those of the model's lumen at 9")) << of_wall;
  EXPECT_TRUE(
      of_wall.ends_with(" % of the places that it faces: is it the surface of the wall, and not of the lumen alone?"))
      << of_wall;
  folder.file("part.stl", stl_text(tube(16, 8, 1.2, [](double) { return 1.1; })));
  const std::vector<std::string> notes = load("  surfaces: {ct: {file: part.stl, unit: cm}}\n").notes();
  EXPECT_EQ(notes.back().substr(0, 21), "ct: part.stl: faces 2") << notes.back();
}

/// As voxels show a vessel that ends with the image.
TEST_F(Load, FlatEndsOfASegmentationAreNoWall) {
  TriangleSurface closed = vessel(1.1);
  const LumenSurface as_lumen = lumen(closed);
  closed = closed_by_fans(as_lumen);
  folder.file("a.stl", stl_text(closed));
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
