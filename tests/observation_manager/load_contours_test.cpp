// Contours as people have them, and what is said of bad ones.

#include "tests/io/work.hpp"
#include "tests/observation_manager/measured_files.hpp"

namespace tether::testing {
namespace load_test {

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

/// The model is cut for each of them.
TEST_F(Load, HasNoMoreSlicesThanAnyImaging) {
  const auto said = [&](int slices) {
    std::string rows = heading;
    for (int i = 0; i < slices; ++i)
      for (const char* point : {"11,0", "0,11", "-11,0"}) rows += fmt::format("{},0,0,{},15\n", i, point);
    folder.file("c.csv", rows);
    return message("  contours: {mr: {file: c.csv, samples: 8}}\n");
  };
  EXPECT_EQ(said(2000), "accepted");
  const Work work;
  EXPECT_EQ(said(100'000),
            "c.csv: has more than 2000 slices and contours: must be at most so many, each in any number of frames");
  EXPECT_LT(work.seconds(), 10);
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
  EXPECT_EQ(csv(heading + good, ", unit: mm"), "accepted");
  EXPECT_EQ(csv(heading + good, ", unit: cm"),
            "c.csv:2: column 'x': is in mm by its heading, in cm by the case: must be the same, or stated once");
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

TEST_F(Load, NotesASliceFarFromTheModel) {
  folder.file("c.csv", heading + circle_rows("A", 0, 0, 11, 15) + moved_rows(circle_rows("B", 0, 0, 11, 25), 80));
  const std::vector<std::string> notes = load("  contours: {mr: {file: c.csv}}\n").notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0].substr(0, 83),
            "mr: slice B: at most 0 % of the places of the lumen that it faces lie within 0.981 ");
}

TEST_F(Load, LeavesOutRepeatedPointsAndSaysSo) {
  const std::string rows = circle_rows("A", 0, 0, 11, 15), last = rows.substr(rows.rfind('A'));
  folder.file("c.csv", heading + rows + last + last);
  EXPECT_EQ(load("  contours: {mr: {file: c.csv}}\n").notes(),
            std::vector<std::string>{"mr: 2 points that repeat the one before are left out"});
}

}  // namespace load_test
}  // namespace tether::testing
