#include <fmt/format.h>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"

/// Cases that begin with the last state of another run, on a coarse configs/tube. Steps of a power of two, so that a
/// clock that starts at a step's end has the same bits as one that has come there.
namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr int first_steps = 6, all_steps = 10;

class InitialStateOfARun : public ::testing::Test {
 protected:
  InitialStateOfARun() {
    case_variant(TETHER_SOURCE "/configs/tube/case.yaml", folder / "case",
                 {{"around: 24", "around: 12"}, {"along: 20", "along: 8"}, {"step: 2e-3", "step: 0.001953125"}});
  }
  ChildEnd simulate(const fs::path& case_file, const std::string& output, int steps) const {
    return capture({{TETHER_PROGRAM, "simulate", case_file.string(), "--output", (folder / output).string(), "--steps",
                     std::to_string(steps), "--overwrite"},
                    {}});
  }
  /// A case that builds on the tube and begins where the run `begun` ended.
  fs::path case_with(const std::string& name, const std::string& more) const {
    return folder.file("case/" + name + ".yaml",
                       fmt::format("base: case.yaml\nname: {}\ninitial_state: {{from: ../begun}}\n{}", name, more));
  }
  void begin() const { ASSERT_EQ(simulate(folder / "case/case.yaml", "begun", first_steps).exit_code, 0); }
  void expect_refused(const fs::path& case_file, const std::string& message) const {
    const ChildEnd end = simulate(case_file, "refused", 1);
    EXPECT_EQ(end.exit_code, 2) << end.output;
    EXPECT_NE(end.errors.find(message), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find("initial_state.from"), std::string::npos) << end.errors;
  }
  /// The last rows of a run's table.
  std::vector<std::string> last_rows(const std::string& output, std::size_t count) const {
    std::ifstream table(folder / output / "timeseries.csv");
    std::vector<std::string> rows;
    for (std::string row; std::getline(table, row);) rows.push_back(row);
    return {rows.end() - static_cast<std::ptrdiff_t>(std::min(count, rows.size())), rows.end()};
  }
  TemporaryFolder folder;
};

TEST_F(InitialStateOfARun, GoesOnAsTheRunItselfWould) {
  begin();
  ASSERT_EQ(simulate(folder / "case/case.yaml", "whole", all_steps).exit_code, 0);
  const fs::path on = case_with("on", fmt::format("time: {{start: {}}}\n", first_steps * 0.001953125));
  const ChildEnd end = simulate(on, "on", all_steps - first_steps);
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("the phase of the beat of 0.825 s is the same"), std::string::npos) << end.output;
  EXPECT_EQ(last_rows("on", all_steps - first_steps), last_rows("whole", all_steps - first_steps));
  const auto state = [&](const char* run, const char* code) {
    return content_of(folder / run / "checkpoint" / code).substr(48);  // what follows the head, which has the step
  };
  EXPECT_EQ(state("on", "solid.bin"), state("whole", "solid.bin"));
  EXPECT_EQ(state("on", "fluid.bin"), state("whole", "fluid.bin"));
}

/// Other numbers, another outlet, a ring let go, an effect more: the vessel goes on from where it was.
TEST_F(InitialStateOfARun, TakesAnotherModelOfTheSameMesh) {
  begin();
  const fs::path other = case_with("other",
                                   "fluid: {outlets: {outlet: {type: resistance, resistance: 1000, "
                                   "proximal_resistance: , distal_resistance: , compliance: , distal_pressure: }}}\n"
                                   "solid: {material: {young: 5e6}, rings: {outlet_ring: {type: free}}, "
                                   "effects: {aneurysm: {type: stiffness_factor, factor: 2, region: opposite}}}\n");
  const ChildEnd end = simulate(other, "other", 2);
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("inflows and motions jump by -0.01172 s of their beat"), std::string::npos) << end.output;
  ASSERT_EQ(simulate(other, "other", 3).exit_code, 0) << "again, from the same state";
}

TEST_F(InitialStateOfARun, IsRefusedWhereItDoesNotBelong) {
  begin();
  expect_refused(case_with("finer", "mesh: {swept: {around: 16}}\n"),
                 "is of another mesh: its lumen has 108 nodes, this one 144");
  expect_refused(case_with("wider", "mesh: {swept: {radius: 2.1}}\n"), "the 108 nodes of its lumen lie elsewhere");
  expect_refused(case_with("thicker", "mesh: {swept: {wall_thickness: 0.3}}\n"), "belongs to another wall");
  expect_refused(case_with("other_image", "image: {pressure: 80 mmHg}\n"), "relative to 70.9 mmHg in the image");
  fs::create_directories(folder / "empty");
  expect_refused(folder.file("case/none.yaml", "base: case.yaml\nname: none\ninitial_state: {from: ../empty}\n"),
                 "holds no checkpoint");
  const ChildEnd own = simulate(case_with("own", ""), "begun", 1);
  EXPECT_EQ(own.exit_code, 2);
  EXPECT_NE(own.errors.find("begun: is read, and what is written into"), std::string::npos) << own.errors;
  EXPECT_TRUE(fs::exists(folder / "begun/checkpoint/master.bin")) << "and is left as it was";
}

}  // namespace
}  // namespace tether
