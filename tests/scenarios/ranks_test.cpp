/// Tether's own codes in several processes each (coupling.ranks): the same run, and one message whoever dies.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>
#include <future>
#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "tests/io/mpirun.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/processes.hpp"
#include "tests/scenarios/run_table.hpp"
#include "tests/scenarios/simulate.hpp"

namespace tether {
namespace ranks_test {

using Json = nlohmann::json;

constexpr int steps = 8, saved_at = 4;
/// Of the interface's velocity each step leaves 1e-6 (coupling.tolerance).
constexpr double as_coupled = 1e-5;

class Ranks : public ::testing::Test {
 protected:
  Ranks() {
    folder.file("one.yaml",
                fmt::format("base: {}/configs/tube/case.yaml\nname: one\nmesh: {{swept: {{around: 12, along: 8}}}}\n"
                            "output: {{checkpoint_every: {}}}\n"
                            "fluid: {{sections: {{middle: {{point: [0, 0, 5], normal: [0, 0, 1]}}}}}}\n",
                            TETHER_SOURCE, saved_at));
    folder.file("several.yaml", "base: one.yaml\nname: several\ncoupling: {ranks: {fluid: 3, solid: 2}}\n");
  }
  std::vector<std::string> words(const std::string& name, const std::string& output, int until,
                                 const std::vector<std::string>& more) const {
    return simulate_line(folder / (name + ".yaml"), folder / output, until, more);
  }
  ChildEnd simulate(const std::string& name, const std::string& output, int until,
                    const std::vector<std::string>& more = {"--overwrite", "--quiet"}) const {
    return capture({words(name, output, until, more), {}});
  }
  /// What the loop needed is no result.
  void expect_same(const std::string& one, const std::string& other, std::size_t until) const {
    expect_same_table(folder / one, folder / other, until, as_coupled, "coupling.");
  }
  void expect_done(const ChildEnd& end) const { ASSERT_EQ(end.exit_code, 0) << end.errors; }
  Json summary(const std::string& output) const { return Json::parse(content_of(folder / output / "summary.json")); }

  TemporaryFolder folder;
};

TEST_F(Ranks, ComputeTheRunOfOneProcess) {
  expect_done(simulate("one", "one", steps));
  expect_done(simulate("several", "several", steps));
  expect_same("one", "several", steps);
  EXPECT_LT(summary("several")["mass_balance_error_max"], 1e-9);
  EXPECT_EQ(content_of(folder / "one/fluid.pvd"), content_of(folder / "several/fluid.pvd"));
}

TEST_F(Ranks, AreThoseOfAnMpirunLine) {
  expect_done(simulate("one", "one", steps));
  const std::string programs = std::filesystem::path(TETHER_PROGRAM).parent_path(), file = folder / "one.yaml";
  expect_done(capture(on_mpirun({"-n", "1", programs + "/fsi_master", file, "--output", folder / "line", "--steps",
                                 std::to_string(steps), ":", "-n", "2", programs + "/fluid", file, ":", "-n", "2",
                                 programs + "/solid", file})));
  expect_same("one", "line", steps);
}

/// How many processes there are is no part of the model.
TEST_F(Ranks, GoOnFromWhatOneProcessSaved) {
  expect_done(simulate("one", "whole", steps));
  expect_done(simulate("one", "out", saved_at));
  expect_done(simulate("several", "out", steps, {"--resume", "--quiet"}));
  EXPECT_EQ(summary("out")["resumed_at_step"], saved_at);
  expect_same("whole", "out", steps);
}

TEST_F(Ranks, GiveTheSameBitsAgain) {
  expect_done(simulate("several", "out", steps));
  expect_done(simulate("several", "again", steps));
  EXPECT_EQ(content_of(folder / "out/timeseries.csv"), content_of(folder / "again/timeseries.csv"));
}

TEST_F(Ranks, PrestressTheWallAsOneProcessDoes) {
  for (const char* wall : {"prestressed", "inflated"}) {
    for (const char* name : {"one", "several"})
      folder.file(fmt::format("{}_{}.yaml", name, wall),
                  fmt::format("base: {}.yaml\nname: {}\nimage: {{pressure: 40 mmHg, wall: {}}}\n", name, wall, wall));
    expect_done(simulate(fmt::format("one_{}", wall), "one", saved_at));
    expect_done(simulate(fmt::format("several_{}", wall), "several", saved_at));
    expect_same("one", "several", saved_at);
  }
}

TEST_F(Ranks, TellAsOneProcessDoesWhatDoesNotWork) {
  for (const char* name : {"one", "several"})
    folder.file(
        fmt::format("{}_torn.yaml", name),
        fmt::format("base: {}.yaml\nname: torn\nfluid: {{inlets: {{inlet: {{flow: {{scale: 1e6}}}}}}}}\n", name));
  const ChildEnd one = simulate("one_torn", "one", steps), several = simulate("several_torn", "several", steps);
  EXPECT_EQ(one.exit_code, 1) << one.output;
  EXPECT_EQ(several.exit_code, 1) << several.output;
  EXPECT_NE(several.errors.find("step 1"), std::string::npos) << several.errors;
}

/// Kills the last process of a code in mid-run.
TEST_F(Ranks, EndTheRunWithOneMessageWhenOneOfThemDies) {
  for (const char* code : {"fluid", "solid"}) {
    const auto case_file = folder / "several.yaml";
    auto end = std::async(std::launch::async, [this, code] { return simulate("several", code, 400); });
    while (!std::filesystem::exists(folder / code / "checkpoint") &&
           end.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready)
      continue;
    const std::vector<pid_t> all = processes_of(code, case_file);
    ASSERT_GE(all.size(), 2U) << code;
    kill(all.back(), SIGKILL);
    const ChildEnd ended = end.get();
    EXPECT_EQ(ended.exit_code, 1) << ended.errors;
    EXPECT_NE(ended.errors.find(fmt::format("(pid {} on", all.back())), std::string::npos) << ended.errors;
    EXPECT_NE(ended.errors.find("--resume"), std::string::npos) << ended.errors;
    EXPECT_EQ(orphan_of({"mpirun", "fsi_master", "fluid", "solid"}, {case_file}), "");
  }
}

}  // namespace ranks_test
}  // namespace tether
