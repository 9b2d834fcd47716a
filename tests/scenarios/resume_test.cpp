#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "common/base/child_process.hpp"
#include "tests/faults/fault.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"

/// `tether simulate` with the real programs on a coarse configs/tube: stopped or killed, then resumed, it leaves the
/// same files as a run that was never interrupted, byte for byte.
namespace tether {
namespace {

namespace fs = std::filesystem;
constexpr int all_steps = 12;

class ResumedRun : public ::testing::Test {
 protected:
  explicit ResumedRun(const std::string& method = "newton_krylov") {
    case_file = case_variant(TETHER_SOURCE "/configs/tube/case.yaml", folder / "case",
                             {{"around: 24", "around: 12"},
                              {"along: 20", "along: 12"},
                              {"write_every: 10", "write_every: 3"},
                              {"checkpoint_every: 100", "checkpoint_every: 4"},
                              {"coupling: {", coupling(method)}});
    std::ofstream ring(folder / "case/ring.csv");
    ring << "slice, frame, time [s], x [cm], y [cm], z [cm]\n";
    for (int frame = 0; frame < 2; ++frame)
      for (int k = 0; k < 40; ++k) {
        const double radius = 2.02 + 0.05 * frame, angle = 2 * std::numbers::pi * k / 40;
        ring << fmt::format("middle, {}, {}, {}, {}, 5\n", frame, frame, radius * cos(angle), radius * sin(angle));
      }
  }
  static std::string coupling(const std::string& method) {
    if (method != "observed") return "coupling: {method: " + method + ", ";
    return "observer: {gain: 60}\nobservations: {contours: {ring: {file: ring.csv}}}\ncoupling: {";
  }
  ChildEnd simulate(const std::string& output, int steps, const std::vector<std::string>& options = {},
                    std::vector<std::pair<std::string, std::string>> environment = {}) const {
    std::vector<std::string> words{TETHER_PROGRAM,  "simulate", case_file.string(),    "--output",
                                   folder / output, "--steps",  std::to_string(steps), "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    return capture({words, std::move(environment)});
  }
  nlohmann::json summary(const std::string& output) const {
    return nlohmann::json::parse(content_of(folder / output / "summary.json"));
  }
  void expect_same_results(const std::string& one, const std::string& other) const {
    for (const char* name : {"timeseries.csv", "lumen.motion", "fluid.pvd", "solid.pvd"})
      EXPECT_EQ(content_of(folder / one / name), content_of(folder / other / name)) << name;
    int compared = 0;
    for (const auto& entry : fs::directory_iterator(folder / one / "vtk")) {
      EXPECT_TRUE(content_of(entry.path()) == content_of(folder / other / "vtk" / entry.path().filename()))
          << entry.path().filename();
      ++compared;
    }
    EXPECT_EQ(compared, 2 * (1 + all_steps / 3));
    for (const char* key : {"steps", "coupling_iterations", "krylov_iterations", "mass_balance_error_max", "pressure",
                            "max_displacement"})
      EXPECT_EQ(summary(one)[key], summary(other)[key]) << key;
  }
  TemporaryFolder folder;
  fs::path case_file;
};

class Resume : public ResumedRun, public ::testing::WithParamInterface<const char*> {
 protected:
  Resume() : ResumedRun(GetParam()) {}
};

TEST_P(Resume, LeavesTheFilesOfARunThatWasNotInterrupted) {
  ASSERT_EQ(simulate("whole", all_steps).exit_code, 0);

  ASSERT_EQ(simulate("stopped", 6).exit_code, 0);
  ASSERT_EQ(simulate("stopped", all_steps, {"--resume"}).exit_code, 0);
  EXPECT_EQ(summary("stopped")["resumed_at_step"], 6);
  expect_same_results("whole", "stopped");

  const ChildEnd killed =
      simulate("killed", all_steps, {}, with_fault("solid:open:vtk/solid_000009:1:KILL", folder / "killed"));
  EXPECT_EQ(killed.exit_code, 1);
  EXPECT_NE(killed.errors.find("solid (pid"), std::string::npos) << killed.errors;
  ASSERT_EQ(simulate("killed", all_steps, {"--resume"}).exit_code, 0);
  EXPECT_EQ(summary("killed")["resumed_at_step"], 8);
  expect_same_results("whole", "killed");
}

/// A case in another file that builds on the first and only lasts longer goes on; wall clock and CPU then are of the
/// same steps, all of them.
TEST_F(ResumedRun, TakesALongerCase) {
  ASSERT_EQ(simulate("whole", all_steps).exit_code, 0);
  ASSERT_EQ(simulate("begun", 6).exit_code, 0);
  const auto before = summary("begun");
  const fs::path longer = folder.file("case/longer.yaml", "base: case.yaml\nname: longer\ntime: {end: 0.024}\n");
  const ChildEnd end =
      capture({{TETHER_PROGRAM, "simulate", longer.string(), "--output", folder / "begun", "--resume", "--quiet"}, {}});
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  expect_same_results("whole", "begun");
  const auto after = summary("begun");
  EXPECT_EQ(after["case"], "longer");
  for (const char* process : {"fsi_master", "fluid", "solid", "total"}) {
    EXPECT_GT(after["loop_cpu_seconds"][process], before["loop_cpu_seconds"][process]) << process;
    EXPECT_GT(after["cpu_seconds"][process], before["cpu_seconds"][process]) << process;
    EXPECT_GE(after["peak_memory_mb"][process], before["peak_memory_mb"][process]) << process;
  }
  EXPECT_NEAR(after["cpu_seconds_per_step"], after["loop_cpu_seconds"]["total"].get<double>() / all_steps, 1e-12);
  EXPECT_NEAR(after["seconds_per_step"], after["wall_seconds"].get<double>() / all_steps, 1e-12);
}

/// How the wall rests is written once, at the beginning, and read at the end: cut in between, it costs no run.
TEST_F(ResumedRun, WritesADamagedRestStateAnew) {
  ASSERT_EQ(simulate("whole", all_steps).exit_code, 0);
  ASSERT_EQ(simulate("stopped", 6).exit_code, 0);
  const fs::path rest = folder / "stopped/rest.json";
  fs::resize_file(rest, fs::file_size(rest) / 2);
  const ChildEnd end = simulate("stopped", all_steps, {"--resume"});
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.errors.find("rest.json"), std::string::npos) << end.errors;
  EXPECT_NE(end.errors.find("written anew"), std::string::npos) << end.errors;
  expect_same_results("whole", "stopped");
  std::ifstream again(rest), first(folder / "whole/rest.json");
  EXPECT_EQ(nlohmann::json::parse(again), nlohmann::json::parse(first));
}

/// It is told in the summary of the run: of the wall that goes on, not what somebody has made of it.
TEST_F(ResumedRun, WritesARestStateThatWasChangedAnew) {
  ASSERT_EQ(simulate("whole", all_steps).exit_code, 0);
  ASSERT_EQ(simulate("stopped", 6).exit_code, 0);
  const fs::path rest = folder / "stopped/rest.json";
  nlohmann::json changed = nlohmann::json::parse(content_of(rest));
  changed["wall"] = "as somebody has it";
  std::ofstream(rest) << changed;
  ASSERT_EQ(simulate("stopped", all_steps, {"--resume"}).exit_code, 0);
  EXPECT_EQ(summary("stopped")["rest"], summary("whole")["rest"]);
  EXPECT_EQ(nlohmann::json::parse(content_of(rest)), nlohmann::json::parse(content_of(folder / "whole/rest.json")));
}

/// Whoever frees the disk of frames goes on without them, and is told.
TEST_F(ResumedRun, ListsNoFramesThatAreGone) {
  ASSERT_EQ(simulate("stopped", 6).exit_code, 0);
  fs::remove_all(folder / "stopped/vtk");
  const ChildEnd end = simulate("stopped", all_steps, {"--resume"});
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.errors.find("fluid.pvd: 3 of the files that it lists are gone"), std::string::npos) << end.errors;
  for (const char* series : {"fluid.pvd", "solid.pvd"})
    EXPECT_EQ(content_of(folder / "stopped" / series).find("_000006"), std::string::npos) << series;
}

/// What a loss of power may leave, or a flipped bit: the newest checkpoint is further than the tables.
TEST_F(ResumedRun, GoesOnFromTheCheckpointThatItsTablesReach) {
  ASSERT_EQ(simulate("whole", all_steps).exit_code, 0);
  ASSERT_EQ(simulate("stopped", 6).exit_code, 0);
  const fs::path motion = folder / "stopped/lumen.motion", table = folder / "stopped/timeseries.csv";
  fs::copy(folder / "stopped", folder / "fewer_rows", fs::copy_options::recursive);
  const std::string rows = content_of(table);
  fs::resize_file(folder / "fewer_rows/timeseries.csv", rows.rfind('\n', rows.size() - 2) + 1);
  fs::resize_file(motion, fs::file_size(motion) - 1);
  for (const auto& [name, told] : {std::pair("stopped", "lumen.motion: has 6 records; the run to resume made 7"),
                                   {"fewer_rows", "timeseries.csv: has 5 rows, the checkpoint 6"}}) {
    const ChildEnd end = simulate(name, all_steps, {"--resume"});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_NE(end.errors.find(std::string(told) + ": the run goes on from the checkpoint before, step 4"),
              std::string::npos)
        << end.errors;
    expect_same_results("whole", name);
  }
  fs::copy(folder / "stopped", folder / "none_before", fs::copy_options::recursive);
  fs::remove_all(folder / "none_before/checkpoint.previous");
  fs::resize_file(folder / "none_before/lumen.motion", fs::file_size(motion) - 1);
  fs::resize_file(motion, 5);
  for (const char* name : {"stopped", "none_before"}) {
    const ChildEnd refused = simulate(name, all_steps + 1, {"--resume"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.errors.find("start anew without --resume"), std::string::npos) << refused.errors;
  }
}

/// Numbers that somebody changed in the table of an interrupted run would be its results.
TEST_F(ResumedRun, TakesNoTableThatWasChanged) {
  ASSERT_EQ(simulate("whole", all_steps).exit_code, 0);
  ASSERT_EQ(simulate("late", 6).exit_code, 0);
  fs::copy(folder / "late", folder / "early", fs::copy_options::recursive);
  const auto change_a_digit_of_row = [&](const char* name, int row) {
    const fs::path table = folder / name / "timeseries.csv";
    std::string rows = content_of(table);
    std::size_t begin = 0;
    for (int line = 0; line < row; ++line) begin = rows.find('\n', begin) + 1;
    char& digit = rows.at(rows.find('.', rows.find(',', begin)) + 3);
    digit = digit == '1' ? '2' : '1';
    std::ofstream(table) << rows;
  };
  change_a_digit_of_row("late", 5);
  const ChildEnd end = simulate("late", all_steps, {"--resume"});
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.errors.find("timeseries.csv: was changed: its first 6 rows are not those that the run wrote: the run "
                            "goes on from the checkpoint before, step 4"),
            std::string::npos)
      << end.errors;
  expect_same_results("whole", "late");
  change_a_digit_of_row("early", 2);
  const ChildEnd refused = simulate("early", all_steps, {"--resume"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("was changed"), std::string::npos) << refused.errors;
  EXPECT_NE(refused.errors.find("start anew without --resume"), std::string::npos) << refused.errors;
}

INSTANTIATE_TEST_SUITE_P(Coupling, Resume, ::testing::Values("newton_krylov", "iqn_ils", "observed"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace tether
