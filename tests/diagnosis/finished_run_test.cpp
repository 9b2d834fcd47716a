#include "diagnosis/comparison/finished_run.hpp"

#include <fmt/format.h>

#include "common/config/case_tree.hpp"
#include "common/config/input_files.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/io/record_file.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* common = "name: tube\nunits: cgs\ntime: {step: 0.1, end: 0.2}\n";

/// Of two steps of the case as it and its files now are.
RunSummary summary_of(const fs::path& case_file) {
  RunSummary summary;
  summary.steps = 2;
  summary.made_from.case_text = case_text(case_file);
  for (const InputFile& input : input_files(case_file))
    summary.made_from.files.push_back({input.field, input.name, fmt::format("{:016x}", input.content)});
  return summary;
}

/// A case with a curve, and an output folder that looks like its finished run of two steps.
class FinishedRunTest : public ::testing::Test {
 protected:
  FinishedRunTest() {
    fs::create_directories(output);
    for (const char* name : {"lumen.motion", "timeseries.csv"}) std::ofstream(output / name);
    folder.file("flow.csv", "t, q\n");
    write_summary("case.yaml", with_solid);
  }
  void write_summary(const std::string& name, const std::string& text) const {
    write_record(output / "summary.json", summary_of(folder.file(name, text)));
  }
  std::string why_not(const std::string& text, int steps = 2) const {
    return why_not_run(output, CaseFile(folder.file("case.yaml", text)), steps).value_or("it can");
  }
  std::string said(const std::string& text) const { return "the run in " + output.string() + text; }

  const std::string with_solid = std::string(common) + "fluid: {flow: flow.csv}\nsolid: {young: 1, regions: [1, 2]}\n";
  TemporaryFolder folder;
  fs::path output = folder / "out";
};

TEST_F(FinishedRunTest, IsTheCaseApartFromWhatDoesNotChangeARun) {
  EXPECT_EQ(why_not(with_solid), "it can");
  EXPECT_EQ(why_not("# moved by a line\n" + with_solid + "title: A tube\nobservations: {contours: {}}\noutput: {}\n"),
            "it can");
  EXPECT_EQ(why_not(with_solid, 1), "it can") << "longer than asked for";
}

TEST_F(FinishedRunTest, FollowedThePointsOfTheCase) {
  write_summary("case.yaml", with_solid + "output: {points: {a: [0, 0, 1], b: [0, 0, 2]}}\n");
  EXPECT_EQ(why_not(with_solid + "output: {write_every: 3, points: {b: [0, 0, 2]}}\n"), "it can");
  EXPECT_EQ(why_not(with_solid), "it can");
  EXPECT_EQ(why_not(with_solid + "output: {points: {a: [0, 0, 1], b: [0, 0, 3]}}\n"),
            said(" did not follow the point 'b' of output.points, or elsewhere"));
  EXPECT_EQ(why_not(with_solid + "output: {points: {c: [0, 0, 1]}}\n"),
            said(" did not follow the point 'c' of output.points, or elsewhere"));
}

TEST_F(FinishedRunTest, IsNotThatOfAnotherCase) {
  EXPECT_EQ(why_not(std::string(common) + "fluid: {flow: flow.csv}\nsolid: {young: 2, regions: [1, 2]}\n"),
            said(" had another 'solid'"));
  EXPECT_EQ(why_not(std::string(common) + "fluid: {flow: flow.csv}\nsolid: {young: 1, regions: [2, 1]}\n"),
            said(" had another 'solid'"));
  EXPECT_EQ(why_not(std::string(common) + "fluid: {flow: flow.csv}\n"), said(" had another 'solid'"));
  EXPECT_EQ(why_not(with_solid + "observer: {gain: 3}\n"), said(" had another 'observer'"));
}

TEST_F(FinishedRunTest, DependsOnMeasurementsIfAnObserverFollowsThem) {
  const std::string observed = with_solid + "observer: {gain: 3}\nobservations: {contours: {}}\n";
  write_summary("case.yaml", observed);
  EXPECT_EQ(why_not(observed), "it can");
  EXPECT_EQ(why_not(with_solid + "observer: {gain: 3}\n"), said(" had another 'observations'"));
}

TEST_F(FinishedRunTest, OneThatIsDamagedSaysWhere) {
  EXPECT_EQ(damage_of(output).value_or("none"), (output / "lumen.motion").string() + ": is not the motion of a lumen");
  LumenMotionWriter writer(output / "lumen.motion", Points::Random(3, 4));
  writer.start();
  for (int step = 0; step <= 2; ++step) writer.append(0.1 * step, Points::Random(3, 4));
  const std::string table = (output / "timeseries.csv").string();
  EXPECT_EQ(damage_of(output).value_or("none"), table + ": has no rows");
  folder.file("out/timeseries.csv", "time [s]\n0.1\n");
  EXPECT_EQ(damage_of(output).value_or("none"), table + ": is cut short: it has 1 rows of a run of 2 steps");
  folder.file("out/timeseries.csv", "time [s]\n0.1\n0.2\n");
  RunSummary summary = summary_of(folder / "case.yaml");
  summary.written = hashes_of_results(output);
  write_record(output / "summary.json", summary);
  EXPECT_EQ(damage_of(output), std::nullopt);
  folder.file("out/timeseries.csv", "time [s]\n0.1\n0.3\n");
  EXPECT_EQ(damage_of(output).value_or("none"), table + ": was changed after the run: it is not what the run wrote");
  folder.file("out/timeseries.csv", "time [s]\n0.1\n0.2\n");
  const fs::path motion = output / "lumen.motion";
  fs::copy_file(motion, output / "own.motion");
  writer.start();
  for (int step = 0; step <= 2; ++step) writer.append(0.1 * step, Points::Random(3, 4));
  EXPECT_EQ(damage_of(output).value_or("none"),
            motion.string() + ": was changed after the run: it is not what the run wrote")
      << "whole, and of another run";
  fs::rename(output / "own.motion", motion);
  EXPECT_EQ(damage_of(output), std::nullopt);
  BloodVelocityWriter(output / "blood.velocity", Points::Random(3, 2)).start();
  EXPECT_NE(damage_of(output), std::nullopt) << "of no step";
  fs::remove(output / "blood.velocity");
  fs::resize_file(motion, fs::file_size(motion) - 1);
  EXPECT_EQ(damage_of(output).value_or("none"),
            (output / "lumen.motion").string() + ": is cut short: it has 2 records of a run of 2 steps");
  std::ofstream(output / "summary.json") << "{\"steps\": 2";
  EXPECT_EQ(damage_of(output).value_or("none"), (output / "summary.json").string() + ": is no JSON");
}

/// What a file holds counts, and not when it was written.
TEST_F(FinishedRunTest, IsOfFilesThatHeldTheSame) {
  const auto now = fs::file_time_type::clock::now();
  for (const auto written : {now - std::chrono::hours(1), now + std::chrono::hours(1)}) {
    folder.file("flow.csv", "t, q\n");
    fs::last_write_time(folder / "flow.csv", written);
    EXPECT_EQ(why_not(with_solid), "it can");
    folder.file("flow.csv", "t, Q\n");
    fs::last_write_time(folder / "flow.csv", written);
    EXPECT_EQ(why_not(with_solid), "flow.csv is not as it was for the run in " + output.string());
  }
}

TEST_F(FinishedRunTest, IsCoupledInOneWay) {
  RunSummary summary = summary_of(folder / "case.yaml");
  summary.made_from.coupled_otherwise = true;
  write_record(output / "summary.json", summary);
  EXPECT_EQ(why_not(with_solid), said(" was continued with another 'coupling'"));
}

/// The summary holds the merged case, so a change of the base is one of the case; a twin's data change nothing.
TEST_F(FinishedRunTest, OfACaseThatBuildsOnAnother) {
  fs::create_directories(folder / "base");
  std::ofstream(folder / "base/flow.csv") << "t, q\n";
  folder.file("base/case.yaml", with_solid);
  const std::string over = "base: base/case.yaml\nname: other\nsolid: {young: 3}\n";
  write_summary("case.yaml", over);
  EXPECT_EQ(why_not(over), "it can");
  EXPECT_EQ(why_not(over + "twin: {truth: x}\n"), "it can");
  folder.file("base/case.yaml", with_solid + "coupling: {tolerance: 1}\n");
  EXPECT_EQ(why_not(over), said(" had another 'coupling'"));
  folder.file("base/case.yaml", with_solid);
  EXPECT_EQ(why_not("base: base/case.yaml\nname: other\nsolid: {young: 4}\n"), said(" had another 'solid'"));
  std::ofstream(folder / "base/flow.csv") << "t, Q\n";
  EXPECT_EQ(why_not(over), "base/flow.csv is not as it was for the run in " + output.string());
}

TEST_F(FinishedRunTest, IsFinished) {
  EXPECT_EQ(why_not(with_solid, 3), said(" ended after 2 of 3 steps"));
  fs::remove(output / "summary.json");
  EXPECT_EQ(why_not(with_solid), output.string() + " holds no finished run");
}

}  // namespace
}  // namespace tether
