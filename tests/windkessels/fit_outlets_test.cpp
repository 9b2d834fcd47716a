// tether fit-outlets, from its file to a case.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"
#include "common/config/case_tree.hpp"
#include "common/io/record_file.hpp"
#include "fluid/windkessels/outlets_result.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/windkessels/beats.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

const std::string two_outlets = "outlets: {left: {share: 0.3}, right: {share: 0.7}}\n";
const std::string targets = "pressure: {mean: 93 mmHg, pulse: 50 mmHg}\n";
const std::string flow = "flow: {file: flow.csv, value: flow, period: 0.8}\n";

/// The test's folder with a flow and a file that asks for outlets.
fs::path asked(const std::string& text) {
  const fs::path& folder = test_folder();
  std::ofstream table(folder / "flow.csv");
  table << "time [s], flow [ml/s]\n";
  const PeriodicFlow beat = testing::beat_of_a_heart();
  for (std::size_t i = 0; i < beat.times.size(); ++i) table << beat.times[i] << "," << beat.values[i] << "\n";
  std::ofstream(folder / "outlets.yaml") << "name: outlets\n" << text;
  return folder;
}

ChildEnd fitted(const fs::path& folder) {
  return capture(
      {{TETHER_PROGRAM, "fit-outlets", (folder / "outlets.yaml").string(), "--output", (folder / "out").string()}, {}});
}

FittedOutlets result_of(const std::string& text) {
  const fs::path folder = asked(text);
  const ChildEnd end = fitted(folder);
  EXPECT_EQ(end.exit_code, exit_done) << end.errors;
  return read_record<FittedOutlets>(folder / "out" / "outlets.json");
}

std::string refusal_of(const std::string& text) {
  const ChildEnd end = fitted(asked(text));
  EXPECT_EQ(end.exit_code, exit_input_wrong) << end.output;
  return end.errors;
}

TEST(FitOutlets, MeetsPressuresAndSplit) {
  const FittedOutlets made = result_of(flow + targets + two_outlets);
  EXPECT_NEAR(made.reached.mean, 93, 1e-2);
  EXPECT_NEAR(made.reached.pulse, 50, 1e-3);
  EXPECT_NEAR(made.reached.systolic - made.reached.diastolic, made.reached.pulse, 1e-9);
  ASSERT_EQ(made.outlets.size(), 2U);
  EXPECT_NEAR(made.outlets[1].flow_share, 0.7, 1e-6);
  const double r = made.outlets[1].proximal_resistance + made.outlets[1].distal_resistance;
  EXPECT_NEAR(r, 93 / (0.7 * made.mean_flow), 1e-6);
  EXPECT_NEAR(made.outlets[1].proximal_resistance / r, 0.056, 1e-9);
}

/// A folder of the person's with files of the names that are written.
TEST(FitOutlets, LeavesFilesOfOthersAlone) {
  const fs::path folder = asked(flow + targets + two_outlets);
  fs::create_directories(folder / "out");
  std::ofstream(folder / "out" / "case.yaml") << "precious";
  const ChildEnd end = fitted(folder);
  EXPECT_EQ(end.exit_code, exit_input_wrong);
  EXPECT_EQ(end.errors, (folder / "out").string() +
                            ": holds files that are not what tether fit-outlets made; choose another folder with "
                            "--output, or give --overwrite\n");
  EXPECT_EQ(fs::file_size(folder / "out" / "case.yaml"), 8U);
  fs::remove(folder / "out" / "case.yaml");
  for (int again = 0; again < 2; ++again) EXPECT_EQ(fitted(folder).exit_code, exit_done) << "the same may be made anew";
}

TEST(FitOutlets, SplitsByAreasAndByMurray) {
  const std::string areas = "outlets: {left: {area: 1}, right: {area: 4}}\n";
  EXPECT_NEAR(result_of(flow + targets + areas + "split: {by: area}\n").outlets[0].flow_share, 1.0 / 5, 1e-6);
  EXPECT_NEAR(result_of(flow + targets + areas + "split: {by: murray}\n").outlets[0].flow_share, 1.0 / 9, 1e-6);
  EXPECT_NEAR(result_of(flow + targets + areas + "split: {by: murray, exponent: 2}\n").outlets[0].flow_share, 1.0 / 5,
              1e-6);
}

/// density wave_speed/area, in mmHg s/ml.
TEST(FitOutlets, TakesCharacteristicImpedances) {
  const FittedOutlets made =
      result_of(flow + targets + "outlets: {left: {share: 0.3, area: 2}, right: {share: 0.7, area: 5}}\n" +
                "proximal: {wave_speed: 5 m/s}\n");
  EXPECT_NEAR(made.outlets[0].proximal_resistance, 1.06 * 500 / 2 / 1333.22, 1e-5);
  EXPECT_NEAR(made.reached.pulse, 50, 1e-3);
}

TEST(FitOutlets, ScalesTheFlowToAMean) {
  EXPECT_NEAR(result_of(flow + targets + two_outlets + "mean_flow: 5 l/min\n").mean_flow, 5000.0 / 60, 1e-6);
}

/// What the configurations say of the descending aorta's outlet comes out of its data.
TEST(FitOutlets, GivesTheOutletOfTheDescendingAorta) {
  const fs::path folder = asked(""), file = fs::path(TETHER_SOURCE) / "configs/descending_aorta/outlets.yaml";
  const ChildEnd end =
      capture({{TETHER_PROGRAM, "fit-outlets", file.string(), "--output", (folder / "out").string()}, {}});
  ASSERT_EQ(end.exit_code, exit_done) << end.errors;
  const FittedOutlet made = read_record<FittedOutlets>(folder / "out" / "outlets.json").outlets.at(0);
  EXPECT_NEAR(made.proximal_resistance, 0.09211, 1e-5);
  EXPECT_NEAR(made.distal_resistance, 2.1923, 1e-4);
  EXPECT_NEAR(made.compliance, 0.6348, 2e-4);
  const ChildEnd valid = capture({{TETHER_PROGRAM, "validate", (folder / "out" / "case.yaml").string()}, {}});
  EXPECT_EQ(valid.exit_code, exit_done) << valid.errors;
  EXPECT_EQ(read_case_tree(folder / "out" / "case.yaml").find("name")->text, "descending_aorta_outlets_run")
      << "not the fit's, whose folder holds no run";
  const YamlNode outlet = *read_case_tree(folder / "out" / "case.yaml").find("fluid")->find("outlets")->find("outlet");
  EXPECT_EQ(outlet.find("initial_pressure")->text, fmt::format("{:.6g} mmHg", made.initial_pressure - 70.9));
}

/// The new case has the image's pressure that its outlets are relative to, whatever the old case has.
TEST(FitOutlets, GivesTheCaseTheImagesPressure) {
  const std::string base = "case: " + (fs::path(TETHER_SOURCE) / "configs/tube/case.yaml").string() + "\n";
  const fs::path folder = asked(base + "pressure: {mean: 93 mmHg, pulse: 50 mmHg, venous: 5 mmHg, image: 45 mmHg}\n");
  const ChildEnd end = fitted(folder);
  ASSERT_EQ(end.exit_code, exit_done) << end.errors;
  const FittedOutlet made = read_record<FittedOutlets>(folder / "out" / "outlets.json").outlets.at(0);
  const YamlNode tree = read_case_tree(folder / "out" / "case.yaml");
  EXPECT_EQ(tree.find("image")->find("pressure")->text, "45 mmHg");
  const YamlNode outlet = *tree.find("fluid")->find("outlets")->find("outlet");
  EXPECT_EQ(outlet.find("initial_pressure")->text, fmt::format("{:.6g} mmHg", made.initial_pressure - 45));
  EXPECT_EQ(outlet.find("distal_pressure")->text, "-40 mmHg");
}

TEST(FitOutlets, RefusesWhatCannotBe) {
  EXPECT_NE(refusal_of(flow + targets + "outlets: {left: {share: 0.3}, right: {share: 0.6}}\n").find("sum to 0.9 and"),
            std::string::npos);
  EXPECT_NE(refusal_of(flow + "pressure: {mean: 93 mmHg, pulse: 900 mmHg}\n" + two_outlets).find("cannot be reached"),
            std::string::npos);
  EXPECT_NE(refusal_of(flow + targets + "vessel_compliance: 50 ml/mmHg\n" + two_outlets)
                .find("vessel_compliance: 50 ml/mmHg: leave a pulse pressure of "),
            std::string::npos);
  EXPECT_NE(refusal_of("flow: {file: flow.csv, value: flow, period: 0.8, scale: -1}\n" + targets + two_outlets)
                .find("flow's mean over the beat is -"),
            std::string::npos);
  EXPECT_NE(refusal_of(flow + targets + "outlets: {left: {share: 0.3}, right: {}}\n").find("outlets.right.share"),
            std::string::npos);
  EXPECT_NE(refusal_of(flow + targets + "outlets: {left: {}, right: {area: 1}}\nsplit: {by: area}\n")
                .find("outlets.left.area: must be given"),
            std::string::npos);
  EXPECT_NE(refusal_of("flow: {file: flow.csv, value: flow}\n" + targets + two_outlets).find("needs a period"),
            std::string::npos);
  EXPECT_NE(refusal_of(flow + "pressure: {mean: 93 mmHg}\n" + two_outlets).find("give mean and pulse, or a curve"),
            std::string::npos);
  EXPECT_NE(refusal_of(flow + targets + two_outlets + "splitt: {by: area}\n").find("did you mean 'split'"),
            std::string::npos);
  const std::string base = "case: " + (fs::path(TETHER_SOURCE) / "configs/tube/case.yaml").string() + "\n";
  EXPECT_NE(refusal_of(base + targets + "outlets: {other: {}}\n").find("has no such outlet; it has outlet"),
            std::string::npos);
}

TEST(FitOutlets, RefusesFlowsThatNoVesselCarries) {
  const auto scaled = [&](const std::string& scale) {
    return refusal_of("flow: {file: flow.csv, value: flow, period: 0.8, scale: " + scale + "}\n" + targets +
                      two_outlets);
  };
  EXPECT_NE(scaled("1e15").find("outlets.yaml:2: flow.scale: 1e15: must be at least -1e12"), std::string::npos);
  EXPECT_NE(scaled("1e9").find("more than any vessel carries: see flow.scale"), std::string::npos);
  EXPECT_NE(refusal_of(flow + targets + two_outlets + "mean_flow: 1e15\n").find("carries: see mean_flow"),
            std::string::npos);
}

TEST(FitOutlets, RefusesPressuresThatNoVesselBears) {
  EXPECT_NE(refusal_of(flow + "pressure: {mean: 1e12, pulse: 5e11}\n" + two_outlets)
                .find("pressure.mean: 7.501e+08 mmHg: is more than any vessel bears"),
            std::string::npos);
}

/// A beat of n outlets takes the cube of n.
TEST(FitOutlets, RefusesMoreOutletsThanItEndsWith) {
  std::string many = "outlets:\n";
  for (int i = 0; i < 2000; ++i) many += fmt::format("  o{}: {{share: 0.0005}}\n", i);
  EXPECT_NE(refusal_of(flow + targets + many).find("outlets.yaml:4: outlets: are 2000: must be at most 300"),
            std::string::npos);
}

}  // namespace
}  // namespace tether
