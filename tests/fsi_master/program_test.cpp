#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/child_process.hpp"

/// fsi_master itself, spawning the fakes of tests/fakes.
namespace tether {
namespace {

namespace fs = std::filesystem;

class Program : public ::testing::Test {
 protected:
  Program()
      : folder(fs::path(::testing::TempDir()) / fmt::format("fsi_master_{}", getpid()) /
               ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    write_case("time: {step: 0.01, end: 0.08}");
  }

  void write_case(const std::string& time, const std::string& coupling = "") const {
    std::ofstream(folder / "case.yaml") << "name: fake\nunits: cgs\n"
                                        << time << "\noutput: {checkpoint_every: 4, points: {top: [1, 0, 2]}}\n"
                                        << "coupling:\n  programs: {fluid: " TETHER_FAKES
                                           "/fake_fluid, solid: " TETHER_FAKES
                                        << "/fake_solid}\n"
                                        << coupling;
  }
  ChildEnd run(const std::string& output, std::vector<std::string> options = {}, const std::string& faults = "") const {
    std::vector<std::string> words = launcher_;
    words.insert(words.end(), {TETHER_MASTER, (folder / "case.yaml").string(), "--output", (folder / output).string()});
    words.insert(words.end(), options.begin(), options.end());
    return capture(
        {words, {{"TETHER_FAKE", faults}, {"OMPI_ALLOW_RUN_AS_ROOT", "1"}, {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}}});
  }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder / name).rdbuf();
    return text.str();
  }
  nlohmann::json summary(const std::string& output) const {
    return nlohmann::json::parse(content(output + "/summary.json"));
  }

  fs::path folder;
  std::vector<std::string> launcher_;  ///< words of the command before the program
};

TEST_F(Program, SimulatesAndSumsUp) {
  const ChildEnd end = run("out");
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("step 8/8"), std::string::npos) << end.output;
  const auto json = summary("out");
  EXPECT_EQ(json["steps"], 8);
  EXPECT_EQ(json["coupling_method"], "newton_krylov");
  EXPECT_EQ(json["coupling_iterations"]["mean"], 2.0);
  EXPECT_LE(json["krylov_iterations"]["max"], 3.0);
  EXPECT_EQ(json["versions"]["fluid"], "fake fluid 1");
  EXPECT_EQ(json["effective_case"]["coupling"]["tolerance"], 1e-6);
  for (const char* process : {"fsi_master", "fluid", "solid"}) EXPECT_GT(json["peak_memory_mb"][process], 1.0);
}

TEST_F(Program, BlackBoxesReachTheSameStepByQuasiNewton) {
  ASSERT_EQ(run("newton", {"--quiet"}).exit_code, 0);
  const ChildEnd end = run("black_box", {"--quiet"}, "fluid.tangent=no");
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_EQ(end.output, "");
  EXPECT_EQ(summary("black_box")["coupling_method"], "iqn_ils");
  const double a = summary("newton")["max_displacement"], b = summary("black_box")["max_displacement"];
  EXPECT_NEAR(a, b, 1e-5 * a);
}

TEST_F(Program, StoppedAndResumedRunWritesTheSameTableBitForBit) {
  for (const std::string method : {"newton_krylov", "iqn_ils"}) {
    write_case("time: {step: 0.01, end: 0.08}", "  method: " + method + "\n");
    ASSERT_EQ(run("whole", {"--quiet"}).exit_code, 0);
    ASSERT_EQ(run("parts", {"--quiet", "--steps", "5"}).exit_code, 0);
    const ChildEnd end = run("parts", {"--quiet", "--resume"});
    ASSERT_EQ(end.exit_code, 0) << end.errors;
    EXPECT_EQ(content("whole/timeseries.csv"), content("parts/timeseries.csv")) << method;
    EXPECT_EQ(summary("parts")["resumed_at_step"], 5);
    EXPECT_EQ(summary("parts")["coupling_iterations"], summary("whole")["coupling_iterations"]);
  }
}

TEST_F(Program, AStepThatNeverSucceedsEndsWithHistoryAndLastGoodState) {
  write_case("time: {step: 0.01, end: 0.08}", "  method: iqn_ils\n  max_iterations: 1\n  halvings: 1\n");
  const ChildEnd end = run("out", {"--quiet"});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(
      end.errors.find("step 1 failed: time 0 s, step 0.01 s: not converged to 1e-06 after 1 evaluations; residuals"),
      std::string::npos)
      << end.errors;
  EXPECT_NE(end.errors.find("worst at interface node"), std::string::npos) << end.errors;
  EXPECT_TRUE(fs::exists(folder / "out/checkpoint/master.bin"));
}

TEST_F(Program, AnInterruptedRunSaysWhatIsSavedAndContinuesFromThere) {
  write_case("time: {step: 0.01, end: 1000}");
  const std::string series = (folder / "out/timeseries.csv").string();
  const std::string interrupt_after_steps = fmt::format(
      "set -m; \"$@\" & for i in $(seq 600); do sleep 0.1; [ $(cat {0} 2>/dev/null | wc -l) -gt 8 ] && break; done; "
      "kill -INT $!; wait $!",
      series);
  launcher_ = {"bash", "-c", interrupt_after_steps, "bash"};
  const ChildEnd end = run("out", {"--quiet"});
  launcher_ = {};
  EXPECT_EQ(end.exit_code, 1);
  ASSERT_TRUE(end.errors.starts_with("fsi_master: interrupted in step ")) << end.errors;
  const std::string before = "The state after ";
  const auto place = end.errors.find(before);
  ASSERT_NE(place, std::string::npos) << end.errors;
  const int saved = std::stoi(end.errors.substr(place + before.size()));
  EXPECT_GE(saved, 4);
  const std::string more = std::to_string(saved + 3);
  const ChildEnd resumed = run("out", {"--quiet", "--resume", "--steps", more});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
  ASSERT_EQ(run("whole", {"--quiet", "--steps", more}).exit_code, 0);
  EXPECT_EQ(content("whole/timeseries.csv"), content("out/timeseries.csv"));
}

TEST_F(Program, AFailingPartnerIsNamedAfterTheLastHalving) {
  const ChildEnd end = run("out", {"--quiet"}, "solid.fail=SolidResidual");
  EXPECT_EQ(end.exit_code, 1);
  const auto first = end.errors.find("element 12 is inverted");
  EXPECT_NE(first, std::string::npos) << end.errors;
  EXPECT_EQ(end.errors.find("element 12", first + 1), std::string::npos) << "said again: " << end.errors;
  EXPECT_NE(end.errors.find("step 0.00125 s: the same"), std::string::npos) << end.errors;
}

TEST_F(Program, ANameThatIsAnnouncedTwiceIsRefused) {
  const ChildEnd end = run("out", {"--quiet"}, "solid.announce=twice");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("solid announces a parameter \"stiffness\" twice"), std::string::npos) << end.errors;
}

TEST_F(Program, ANumberOutsideItsOwnLimitsIsRefused) {
  const ChildEnd end = run("out", {"--quiet"}, "solid.announce=outside");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("solid announces stiffness as 50, outside its own limits, 100 and "), std::string::npos)
      << end.errors;
}

TEST_F(Program, WrongInputOfAPartnerIsTheUsersMessage) {
  const ChildEnd end = run("out", {"--quiet"}, "fluid.refuse=hello");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("fluid.density: -1 g/cm3: must be positive"), std::string::npos) << end.errors;
}

TEST_F(Program, ACodeWithoutStateIsSimulatedButNotResumed) {
  const ChildEnd first = run("out", {}, "fluid.state=no");
  EXPECT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_NE(first.output.find("fluid (fake fluid 1) announces no state"), std::string::npos) << first.output;
  const ChildEnd second = run("out", {"--resume", "--quiet"}, "fluid.state=no");
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.errors.find("the fluid (fake fluid 1) announced no state"), std::string::npos) << second.errors;
}

TEST_F(Program, ACheckpointOfAnotherCaseIsRefused) {
  ASSERT_EQ(run("out", {"--quiet"}).exit_code, 0);
  write_case("time: {step: 0.02, end: 0.08}");
  const ChildEnd end = run("out", {"--resume", "--quiet"});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("is a checkpoint of another case, step, mesh or code (time.step: 0.02 now, 0.01 before)"),
            std::string::npos)
      << end.errors;
}

TEST_F(Program, APointFarFromTheVesselIsAMistakeWithItsLine) {
  std::string text = content("case.yaml");
  std::ofstream(folder / "case.yaml") << text.replace(text.find("[1, 0, 2]"), 9, "[10, 0, 20]");
  const ChildEnd end = run("out", {"--quiet"});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_NE(end.errors.find("case.yaml:4: output.points.top: the nearest node of the lumen is 20.12 away"),
            std::string::npos)
      << end.errors;
}

/// What only the codes can tell, too.
TEST_F(Program, ARefusedRunLeavesTheResultsBeforeIt) {
  ASSERT_EQ(run("out", {"--quiet"}).exit_code, 0);
  const std::string table = content("out/timeseries.csv"), summed_up = content("out/summary.json");
  std::string text = content("case.yaml");
  std::ofstream(folder / "case.yaml") << text.replace(text.find("[1, 0, 2]"), 9, "[10, 0, 20]");
  ASSERT_EQ(run("out", {"--quiet"}).exit_code, 2);
  EXPECT_EQ(content("out/timeseries.csv"), table);
  EXPECT_EQ(content("out/summary.json"), summed_up);
  EXPECT_TRUE(fs::exists(folder / "out/checkpoint"));
}

TEST_F(Program, ResumingAFinishedRunChangesNothing) {
  ASSERT_EQ(run("out", {"--quiet"}).exit_code, 0);
  const std::string table = content("out/timeseries.csv");
  ASSERT_EQ(run("out", {"--quiet", "--resume"}).exit_code, 0);
  EXPECT_EQ(content("out/timeseries.csv"), table);
  EXPECT_EQ(summary("out")["steps"], 8);
}

TEST_F(Program, ADeadPartnerEndsTheRunWithOneMessage) {
  const ChildEnd end = run("out", {"--quiet"}, "solid.kill=SolidProduct");
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("solid (pid"), std::string::npos) << end.errors;
}

TEST_F(Program, MissingProgramsAndBadFieldsAreFoundBeforeAnythingRuns) {
  std::ofstream(folder / "case.yaml") << "name: fake\nunits: cgs\ntime: {step: 0.01, end: 0.08}\n"
                                         "coupling: {tolerance: -1, programs: {fluid: /nowhere/fluid}}\n";
  const ChildEnd wrong_field = run("out", {"--validate"});
  EXPECT_EQ(wrong_field.exit_code, 2);
  EXPECT_NE(wrong_field.errors.find("case.yaml:4: coupling.tolerance: -1"), std::string::npos) << wrong_field.errors;
  std::ofstream(folder / "case.yaml") << "name: fake\nunits: cgs\ntime: {step: 0.01, end: 0.08}\n"
                                         "coupling: {programs: {fluid: /nowhere/fluid}}\n";
  const ChildEnd missing = run("out", {"--validate"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.errors.find("/nowhere/fluid does not exist"), std::string::npos) << missing.errors;
}

}  // namespace
}  // namespace tether
