#include <fmt/format.h>

#include <csignal>
#include <future>
#include <thread>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"

/// Results belong to what the files held, and a folder to one run.
namespace tether {
namespace {

namespace fs = std::filesystem;

class ChangedInput : public ::testing::Test {
 protected:
  ChangedInput() {
    case_file = case_variant(
        TETHER_SOURCE "/configs/tube/case.yaml", folder / "case",
        {{"around: 24", "around: 12"}, {"along: 20", "along: 8"}, {"checkpoint_every: 100", "checkpoint_every: 2"}});
    flow = content_of(folder / "case/aortic_flow.csv");
  }
  ChildEnd simulate(int steps, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> words{
        TETHER_PROGRAM,        "simulate", case_file.string(), "--output", (folder / "out").string(), "--steps",
        std::to_string(steps), "--quiet"};
    words.insert(words.end(), options.begin(), options.end());
    return capture({words, {}});
  }
  /// Writes the inflow anew, as of an hour ago.
  void write_flow(const std::string& text) const {
    const fs::path file = folder.file("case/aortic_flow.csv", text);
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
  TemporaryFolder folder;
  fs::path case_file;
  std::string flow;
};

TEST_F(ChangedInput, IsNoContinuation) {
  ASSERT_EQ(simulate(2).exit_code, 0);
  write_flow(flow + "# a remark\n");
  const ChildEnd refused = simulate(4, {"--resume"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("is a checkpoint of another case, step or mesh"), std::string::npos) << refused.errors;
  write_flow(flow);
  const ChildEnd resumed = simulate(4, {"--resume"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
}

/// What was made of the run before goes with it; what another verb made stays.
TEST_F(ChangedInput, LeavesNoComparisonOfTheRunBefore) {
  ASSERT_EQ(simulate(1).exit_code, 0);
  for (const char* name : {"comparison.json", "plots/comparison_ct.png", "plots/estimate.png", "estimate.json"})
    folder.file("out/" + std::string(name), "old");
  ASSERT_EQ(simulate(1).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "out/comparison.json"));
  EXPECT_FALSE(fs::exists(folder / "out/plots/comparison_ct.png"));
  EXPECT_TRUE(fs::exists(folder / "out/plots/estimate.png"));
  EXPECT_TRUE(fs::exists(folder / "out/estimate.json"));
}

TEST_F(ChangedInput, TwoRunsDoNotShareAFolder) {
  auto first = std::async(std::launch::async, [&] { return simulate(100000); });
  while (!fs::exists(folder / "out/checkpoint") &&
         first.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
    continue;
  const ChildEnd second = simulate(2);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.errors.find("another run is writing to this folder: process "), std::string::npos) << second.errors;
  const auto at = second.errors.find("process ");
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(kill(std::stoi(second.errors.substr(at + 8)), SIGTERM), 0);
  EXPECT_EQ(first.get().exit_code, 1);
  const ChildEnd third = simulate(2);
  EXPECT_EQ(third.exit_code, 0) << third.errors;
}

}  // namespace
}  // namespace tether
