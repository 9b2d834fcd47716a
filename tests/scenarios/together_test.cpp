/// Tether's own codes in the master's process: the same run, at less cost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/run_table.hpp"
#include "tests/scenarios/simulate.hpp"

namespace tether {
namespace {

using Json = nlohmann::json;

constexpr int steps = 12, saved_at = 6;

class Together : public ::testing::Test {
 protected:
  Together() {
    folder.file("apart.yaml",
                fmt::format("base: {}/configs/tube/case.yaml\nname: apart\nmesh: {{swept: {{around: 12, along: 8}}}}\n"
                            "output: {{checkpoint_every: {}}}\n",
                            TETHER_SOURCE, saved_at));
    folder.file("together.yaml", "base: apart.yaml\nname: together\ncoupling: {processes: together}\n");
  }
  ChildEnd simulate(const std::string& name, const std::string& output, int until,
                    const std::vector<std::string>& more = {"--overwrite"}) const {
    return capture({simulate_line(folder / (name + ".yaml"), folder / output, until, more), {}});
  }
  Json summary(const std::string& output) const { return Json::parse(content_of(folder / output / "summary.json")); }
  void expect_same_table(const std::string& one, const std::string& other) const {
    tether::expect_same_table(folder / one, folder / other, steps, 1e-7);
  }
  TemporaryFolder folder;
};

/// What several objects define alike is not rounded alike in two programs: no more than that differs.
TEST_F(Together, ItIsTheSameRun) {
  for (const char* name : {"apart", "together"}) {
    const ChildEnd end = simulate(name, name, steps);
    ASSERT_EQ(end.exit_code, 0) << end.errors;
  }
  expect_same_table("apart", "together");
}

TEST_F(Together, ItsCostIsToldByCode) {
  ASSERT_EQ(simulate("together", "out", steps).exit_code, 0);
  const Json cost = summary("out")["cpu_seconds"];
  double sum = 0;
  for (const char* code : {"fluid", "solid", "fsi_master"}) {
    EXPECT_GT(cost[code], 0.0) << cost;
    sum += cost[code].get<double>();
  }
  EXPECT_NEAR(sum, cost["total"], 1e-9);
  const Json memory = summary("out")["peak_memory_mb"];
  EXPECT_EQ(memory["fluid"], 0.0) << "is the master's: " << memory;
  EXPECT_EQ(memory["solid"], 0.0) << memory;
  EXPECT_EQ(memory["fsi_master"], memory["total"]) << memory;
}

/// How the codes are placed is no part of the model.
TEST_F(Together, GoesOnFromWhatWasSavedApart) {
  ASSERT_EQ(simulate("apart", "out", saved_at).exit_code, 0);
  const ChildEnd on = simulate("together", "out", steps, {"--resume"});
  ASSERT_EQ(on.exit_code, 0) << on.errors;
  EXPECT_EQ(summary("out")["resumed_at_step"], saved_at);
  ASSERT_EQ(simulate("apart", "whole", steps).exit_code, 0);
  expect_same_table("whole", "out");
}

TEST_F(Together, SaysWhatIsWrongAsACodeOfItsOwnWould) {
  folder.file("wrong.yaml", "base: together.yaml\nname: wrong\nfluid: {inlets: {inlet: {flow: {scale: 1e6}}}}\n");
  const ChildEnd end = simulate("wrong", "out", steps);
  EXPECT_EQ(end.exit_code, 1) << end.output;
  EXPECT_NE(end.errors.find("fsi_master: "), std::string::npos) << end.errors;
  EXPECT_NE(end.errors.find("step 1"), std::string::npos) << end.errors;
}

}  // namespace
}  // namespace tether
