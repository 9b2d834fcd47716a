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
    const fs::path built = fs::path(TETHER_PROGRAM).parent_path().parent_path();
    return capture({words,
                    {{"PYTHONPATH", TETHER_SOURCE "/tools/python"},
                     {"PYTHONDONTWRITEBYTECODE", "1"},
                     {"TETHER_CLIENT", (built / "lib/libtether_client.so").string()}}});
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
  EXPECT_NE(refused.errors.find("is a checkpoint of another case, step, mesh or code"), std::string::npos)
      << refused.errors;
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

TEST_F(ChangedInput, IsAnotherPlaceOfAPoint) {
  const std::string base = case_file.string();
  case_file = folder / "case/followed.yaml";
  const auto follow = [&](const char* place) {
    folder.file("case/followed.yaml",
                fmt::format("base: {}\nname: followed\noutput: {{points: {{p: {}}}}}\n", base, place));
  };
  follow("[-2, 0, 5]");
  ASSERT_EQ(simulate(2).exit_code, 0);
  follow("[2, 0, 5]");
  EXPECT_EQ(simulate(4, {"--resume"}).exit_code, 2);
  follow("[-2, 0, 5]");
  EXPECT_EQ(simulate(4, {"--resume"}).exit_code, 0);
}

/// A wall of somebody else's, which tells nothing of what it reads.
TEST_F(ChangedInput, IsWhatACodeOfSomebodyElseReads) {
  const fs::path examples = fs::path(TETHER_SOURCE) / "docs/examples";
  std::string code = content_of(examples / "ring_solid.py"), text = content_of(examples / "ring_tube.yaml");
  text.replace(text.find("../../configs"), 13, TETHER_SOURCE "/configs");
  text += "output: {checkpoint_every: 1}\nmesh: {swept: {around: 12, along: 8}}\n";
  const auto replaced = [](std::string in, const std::string& what, const std::string& by) {
    EXPECT_NE(in.find(what), std::string::npos);
    return in.replace(in.find(what), what.size(), by);
  };
  const auto write = [&](const std::string& program, const std::string& of_case) {
    fs::permissions(folder.file("case/ring_solid.py", program), fs::perms::owner_all);
    case_file = folder.file("case/case.yaml", of_case);
  };
  write(code, text);
  ASSERT_EQ(simulate(1).exit_code, 0);
  write(code, replaced(text, "stiffness: 1e5", "stiffness: 2e5"));
  EXPECT_NE(simulate(2, {"--resume"}).errors.find("is a checkpoint of another case"), std::string::npos);
  write(replaced(code, "/ 6", "/ 5"), text);
  EXPECT_NE(simulate(2, {"--resume"}).errors.find("mesh or code"), std::string::npos);
  write(code, replaced(text, "title: Straight", "title: Another"));
  const ChildEnd resumed = simulate(2, {"--resume"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
}

/// By somebody else, after the front-end has read it and before a program does.
TEST_F(ChangedInput, IsToldWhereAFileIsWrittenWhileProgramsStart) {
  const std::string text = content_of(case_file);
  fs::permissions(folder.file("case/late.sh", fmt::format("#!/bin/sh\necho >> {}\nexec {}/solid \"$@\"\n",
                                                          (folder / "case/aortic_flow.csv").string(),
                                                          fs::path(TETHER_PROGRAM).parent_path().string())),
                  fs::perms::owner_all);
  folder.file("case/case.yaml",
              fmt::format("{}\n", std::string(text).replace(text.find("coupling: {"), 11,
                                                            "coupling: {programs: {solid: ./late.sh}, ")));
  const ChildEnd ended = simulate(2);
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.errors.find("aortic_flow.csv: was written during the run"), std::string::npos) << ended.errors;
  EXPECT_FALSE(fs::exists(folder / "out/summary.json"));
  folder.file("case/case.yaml", text);
  EXPECT_EQ(simulate(2).exit_code, 0);
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
