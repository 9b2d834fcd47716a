/// `tether compare` with the real programs on a coarse configs/tube: against surfaces made from its own run, and a
/// trace.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/io/record_file.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/surface_file.hpp"
#include "tests/scenarios/valid_results.hpp"

namespace tether {
namespace compare_test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double step = 2e-3, outward = 0.05, higher = 1000;

/// A run of eight steps, and the case that measures it.
class Compare : public ::testing::Test {
 protected:
  static constexpr const char* source = TETHER_SOURCE "/configs/tube/case.yaml";
  static void SetUpTestSuite() {
    run = fs::temp_directory_path() / ("tether_compare_test_" + std::to_string(getpid()));
    const fs::path coarse = variant(run / "case", {});
    const ChildEnd end = tether("simulate", coarse, run / "out");
    ASSERT_EQ(end.exit_code, 0) << end.errors;
  }
  static void TearDownTestSuite() { fs::remove_all(run); }
  void TearDown() override { expect_valid_results(folder.path()); }
  void SetUp() override {
    fs::copy(run / "out", output, fs::copy_options::recursive);
    compared = variant(folder / "case", {{"output:", measurements()}, {"Straight tube", "A tube"}});
  }
  /// A coarse case with these edits.
  static fs::path variant(const fs::path& at, Edits edits) {
    edits.insert(edits.end(),
                 {{"around: 24", "around: 12"},
                  {"along: 20", "along: 12"},
                  {"solid:\n", "  sections: {middle: {point: [0, 0, 5], normal: [0.1, 0, 1]}}\n\nsolid:\n"}});
    return case_variant(source, at, edits);
  }
  static ChildEnd tether(const std::string& verb, const fs::path& case_file, const fs::path& output) {
    return capture({{TETHER_PROGRAM, verb, case_file.string(), "--output", output.string(), "--steps", "8"}, {}});
  }
  ChildEnd compare() const { return tether("compare", compared, output); }
  /// As if the run had been of this case's file.
  void take_for_own() const {
    std::string marker = content_of(output / "case_as_run.yaml");
    const std::string before = (run / "case/case.yaml").string();
    marker.replace(marker.find(before), before.size(), compared.string());
    std::ofstream(output / "case_as_run.yaml") << marker;
  }
  /// What is measured of the run in `output`: after 2, 4, 8 and 20 steps a wider lumen, after 6 the right one, held
  /// out; and a pressure that is too high.
  std::string measurements() const {
    const LumenMotion motion(output / "lumen.motion");
    const std::vector<Triangle> triangles = ObservedCase(run / "case" / "case.yaml").lumen().triangles;
    std::string list = "file, time [s]\n";
    for (const int k : {2, 4, 6, 8, 20}) {
      Points x = motion.at(step * std::min(k, 8));
      for (auto node : x.colwise())
        if (k != 6) node.head<2>() += outward * node.head<2>().normalized();
      const std::string name = fmt::format("frame_{}.stl", k);
      write_stl(folder / name, x, triangles);
      list += fmt::format("{}, {}\n", name, step * k);
    }
    std::ofstream(folder / "frames.csv") << list;
    const CsvTable table(output / "timeseries.csv", TableOf::tether);
    std::ofstream pressures(folder / "pressures.csv");
    pressures << "time [s], pressure [dyn/cm2]\n";
    for (std::size_t i = 0; i < table.rows(); ++i)
      pressures << fmt::format("{}, {}\n", table.numbers("time")[i],
                               table.numbers("fluid.outlet.pressure")[i] + higher);
    return fmt::format(
        "observations:\n"
        "  surfaces: {{ct: {{file: {0}/frames.csv, unit: cm, held_out: [2], trust_distance: 0.5, noise: {{deviation: "
        "0.2 mm, correlation_length: 4 mm}}}}}}\n"
        "  traces: {{cuff: {{observable: fluid.outlet.pressure, quantity: pressure, absolute: false, curve: {{file: "
        "{0}/pressures.csv, value: pressure}}}}}}\n\noutput:",
        folder.path().string());
  }
  Json comparison() const { return Json::parse(content_of(output / "comparison.json")); }

  static inline fs::path run;
  TemporaryFolder folder;
  fs::path output = folder / "out", compared;
};

/// Group of a kind over all frames; null for the whole wall.
Json all_frames(const Json& source, const char* kind, const Json& region) {
  for (const Json& group : source[kind]["all_frames"])
    if (group["series"].is_null() && group["region"] == region) return group;
  return {};
}

TEST_F(Compare, FindsWhatWasDoneToTheDataAndKeepsTheRun) {
  const auto written = fs::last_write_time(output / "summary.json");

  const ChildEnd end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(fs::last_write_time(output / "summary.json"), written) << "observations and title do not change a run";
  // Nearest places lie on facets of a dodecagon.
  const double distance = outward * std::cos(std::numbers::pi / 12);
  const Json json = comparison(), ct = json["sources"][0];
  for (const char* region : {"spine", "opposite"}) {
    const Json group = all_frames(ct, "training", region);
    EXPECT_NEAR(group["mean"], distance, 1e-3) << region;
    EXPECT_NEAR(group["l2"], distance, 1e-3) << region;
    EXPECT_NEAR(group["in_noise"]["mean"].get<double>(), distance / 0.02, 0.05) << region;
  }
  EXPECT_LT(all_frames(ct, "held_out", nullptr)["linf"], 1e-6);
  EXPECT_GT(all_frames(ct, "held_out", nullptr)["apparent"]["linf"], 1e-5);
  EXPECT_EQ(ct["moments"].size(), 4U);
  ASSERT_EQ(ct["frames_outside_the_run"].size(), 1U);
  EXPECT_EQ(ct["frames_outside_the_run"][0]["frame"], 4);
  EXPECT_TRUE(json["run"]["is_evidence"]);
  EXPECT_NEAR(json["traces"][0]["bias"], higher, 1e-3);
  EXPECT_NEAR(json["traces"][0]["l2"], higher, 1e-3);

  EXPECT_NE(end.output.find("0.004-0.016 s: the model lies 0.48 mm too far inward"), std::string::npos) << end.output;
  EXPECT_NE(end.output.find("ct, held-out frames: in all 4 pairs of region and frame the model is within the noise"),
            std::string::npos);
  EXPECT_NE(end.output.find("ct: 1 of 5 frames are outside the run"), std::string::npos);
  EXPECT_NE(end.output.find("cuff: fluid.outlet.pressure is 0.75 mmHg too low on average"), std::string::npos);
  EXPECT_NE(end.output.find("beside an open rim"), std::string::npos) << "the surfaces end where the model does";
  const CsvTable table(output / "comparison.csv");
  EXPECT_EQ(table.rows(), 4U * 5) << "frames times regions, and the whole wall";
  const CsvTable blood(output / "comparison_blood.csv");
  EXPECT_EQ(blood.rows(), 1U + json["traces"][0]["values"].get<std::size_t>());
  EXPECT_EQ(blood.texts("time")[0], "") << "over all times";
  for (const std::size_t row : {std::size_t{0}, blood.rows() - 1}) {
    EXPECT_EQ(blood.texts("kind")[row], "trace");
    EXPECT_NEAR(blood.numbers("bias")[row], higher, 1e-3);
  }
  for (const char* name : {"comparison_ct.png", "trace_cuff.png", "contours_ct_plane_2.png"})
    EXPECT_GT(fs::file_size(output / "plots" / name), 5000U) << name;
}

/// Velocities that no run has recorded yet, then others at the same points: 10 cm/s more than the run's, along the
/// tube.
TEST_F(Compare, RecordsVelocitiesWhereTheyAreMeasured) {
  const std::string heading = "time [s], x [cm], y [cm], z [cm], v [cm/s]\n";
  const Points places{{0, 0.3, 5}, {0, 0.2, 0}, {2, 2, 2}};
  const auto write = [&](const std::function<double(double, Eigen::Index)>& velocity) {
    std::ofstream file(folder / "plane.csv");
    file << heading;
    for (const double time : {0.004, 0.010, 0.016})
      for (Eigen::Index i = 0; i < places.cols(); ++i)
        file << fmt::format("{}, {}, {}, {}, {:.12g}\n", time, places(0, i), places(1, i), places(2, i),
                            velocity(time, i));
  };
  write([](double, Eigen::Index) { return 0.0; });
  std::string text = content_of(run / "case" / "case.yaml");
  text.replace(text.find("output:"), 7,
               "observations:\n  velocities: {pc_mr: {file: " + (folder / "plane.csv").string() +
                   ", components: along, direction: [0, 0, 1], held_out: [1]}}\n\noutput:");
  std::ofstream(compared) << text;
  fs::remove_all(output);
  ChildEnd end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  const BloodVelocity recorded(output / "blood.velocity");
  EXPECT_EQ(recorded.times().size(), 9U) << "the start and eight steps";
  EXPECT_TRUE(recorded.vectors_at(0.016).col(2).array().isNaN().all()) << "outside the lumen";
  EXPECT_GT(recorded.vectors_at(0.016)(2, 0), 1) << "[cm/s]";

  const auto written = fs::last_write_time(output / "summary.json");
  write([&](double time, Eigen::Index i) { return i == 2 ? 0.0 : recorded.vectors_at(time)(2, i) + 10; });
  end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(fs::last_write_time(output / "summary.json"), written) << "the points are those recorded";
  const Json pc_mr = comparison()["velocities"][0];
  EXPECT_NEAR(pc_mr["training"]["l2"], 10, 1e-6);
  EXPECT_NEAR(pc_mr["held_out"]["bias"], 10, 1e-6);
  EXPECT_EQ(pc_mr["training"]["points"], 4);
  EXPECT_EQ(pc_mr["moments"].size(), 3U);
  EXPECT_EQ(pc_mr["moments"][0]["points_outside_the_lumen"], 1);
  EXPECT_NE(end.output.find("pc_mr: velocities are 0.1 m/s off in root mean square"), std::string::npos) << end.output;
  const CsvTable blood(output / "comparison_blood.csv");
  EXPECT_EQ(blood.rows(), 2U + 3U) << "training and held-out frames, then each of the three";
  EXPECT_EQ(blood.texts("held_out"), (std::vector<std::string>{"0", "1", "0", "1", "0"}));
  EXPECT_NEAR(blood.numbers("l2")[3], 10, 1e-6);
  EXPECT_EQ(blood.numbers("excluded")[2], 1) << "outside the lumen";
  EXPECT_GT(fs::file_size(output / "plots" / "velocity_pc_mr.png"), 5000U);
}

/// Traces of a section inside the vessel: its flow with an offset, its pressure as it is.
TEST_F(Compare, HoldsASectionAgainstItsTraces) {
  const CsvTable run_table(output / "timeseries.csv", TableOf::tether);
  const std::vector<double> times = run_table.numbers("time"), flow = run_table.numbers("fluid.middle.flow"),
                            pressure = run_table.numbers("fluid.middle.pressure");
  std::ofstream table(folder / "doppler.csv");
  table << "time [s], flow [cm3/s], pressure [dyn/cm2]\n";
  for (std::size_t i = 0; i < times.size(); ++i)
    table << fmt::format("{}, {}, {}\n", times[i], flow[i] + 3, pressure[i]);
  table.close();
  EXPECT_GT(flow.back(), 1) << "[cm3/s]";
  EXPECT_NE(flow.back(), run_table.numbers("fluid.outlet.flow").back()) << "the wall gives way";

  const std::string curve = "curve: {file: " + (folder / "doppler.csv").string() + ", value: ";
  std::string text = content_of(run / "case" / "case.yaml");
  text.replace(text.find("output:"), 7,
               "observations:\n  traces:\n    doppler: {observable: fluid.middle.flow, quantity: flow, " + curve +
                   "flow}}\n    catheter: {observable: fluid.middle.pressure, quantity: pressure, absolute: false, " +
                   curve + "pressure}}\n\noutput:");
  std::ofstream(compared) << text;
  const auto written = fs::last_write_time(output / "summary.json");
  const ChildEnd end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(fs::last_write_time(output / "summary.json"), written);
  const Json traces = comparison()["traces"];
  ASSERT_EQ(traces.size(), 2U);
  EXPECT_NEAR(traces[0]["bias"], 3, 1e-6);
  EXPECT_NEAR(traces[0]["l2"], 3, 1e-6);
  EXPECT_NEAR(traces[1]["l2"], 0, 1e-3);
}

TEST_F(Compare, SaysThatAPulledRunIsNoEvidence) {
  auto summary = read_record<RunSummary>(output / "summary.json");
  summary.observer = ObserverWork{.gain = 3};
  write_record(output / "summary.json", summary);
  const ChildEnd end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_TRUE(end.output.starts_with("NO EVIDENCE: this run was pulled toward the data (observer.gain 3 1/s)"))
      << end.output;
  EXPECT_FALSE(comparison()["run"]["is_evidence"]);
}

/// Where the run is there nothing else would claim its folder.
TEST_F(Compare, ReplacesNoDataInTheFolderOfItsRun) {
  const fs::path mine = output / "comparison_blood.csv";
  fs::copy_file(folder / "pressures.csv", mine);
  const std::string data = content_of(mine);
  std::string text = content_of(compared);
  text.replace(text.find((folder / "pressures.csv").string()), (folder / "pressures.csv").string().size(), mine);
  std::ofstream(compared) << text;
  for (const char* verb : {"compare", "measure-noise"}) {
    std::vector<std::string> line{TETHER_PROGRAM, verb, compared.string(), "--output", output.string()};
    if (verb == std::string("compare")) line.insert(line.end(), {"--steps", "8"});  // the run is there
    const ChildEnd end = capture({line, {}});
    EXPECT_EQ(end.exit_code, 2) << verb << ": " << end.output;
    EXPECT_NE(end.errors.find("comparison_blood.csv: is read"), std::string::npos) << verb << ": " << end.errors;
    EXPECT_EQ(content_of(mine), data) << verb;
  }
  fs::remove(mine);  // is no table of results
}

TEST_F(Compare, SimulatesWhatIsNotThere) {
  std::string text = content_of(compared);
  text.replace(text.find("young: 4e6"), 10, "young: 1e7");
  std::ofstream(compared) << text;
  take_for_own();
  const ChildEnd end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("the run in " + output.string() + " had another 'solid': simulating first"),
            std::string::npos)
      << end.output;
  EXPECT_GT(all_frames(comparison()["sources"][0], "held_out", nullptr)["linf"], 1e-5)
      << "another wall moves otherwise";
}

TEST_F(Compare, SimulatesAnewWhereATableIsCutShort) {
  const fs::path table = output / "timeseries.csv";
  const std::string whole = content_of(table);
  std::ofstream(table) << whole.substr(0, whole.find('\n', whole.size() / 2) + 1);
  take_for_own();
  const ChildEnd end = compare();
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.errors.find("timeseries.csv: is cut short"), std::string::npos) << end.errors;
  EXPECT_EQ(content_of(table), whole);
}

/// At the start, not after the whole run.
TEST_F(Compare, RefusesATraceThatTheRunDoesNotHave) {
  std::ofstream(folder / "p.csv") << "time [s], pressure [mmHg]\n0, 80\n1, 90\n";
  const std::string text = content_of(run / "case" / "case.yaml");
  const auto refused = [&](const std::string& observable, const std::string& quantity) {
    std::string with = text;
    with.replace(with.find("output:"), 7,
                 "observations:\n  traces: {cuff: {observable: " + observable + ", quantity: " + quantity +
                     ", curve: {file: " + (folder / "p.csv").string() + ", value: pressure}}}\n\noutput:");
    std::ofstream(compared) << with;
    fs::remove_all(output);
    const ChildEnd end = compare();
    EXPECT_EQ(end.exit_code, 2) << end.output;
    EXPECT_FALSE(fs::exists(output / "summary.json"));
    return end.errors;
  };
  EXPECT_NE(refused("fluid.exit.volume", "pressure").find("the run has no fluid.exit.volume; it has: time, fluid."),
            std::string::npos);
  EXPECT_NE(refused("fluid.volume", "pressure").find("fluid.volume is in cm3, the measurement in g/(cm s2)"),
            std::string::npos);
}

TEST_F(Compare, NeedsMeasurements) {
  const ChildEnd end = tether("compare", run / "case" / "case.yaml", output);
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("observations: names nothing that was measured"), std::string::npos) << end.errors;
}

}  // namespace compare_test
}  // namespace tether
