#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/protocol/run_job.hpp"
#include "tests/sanitizers/built_with.hpp"

/// Whatever dies, whenever, however the job was started: one message, an end of its own accord, no process left.
/// (How soon: benchmarks/failure.)
namespace tether::tests {
namespace {

enum class Start { alone, mpirun, mpmd };

struct Case {
  const char* name;
  Start start;
  const char* fault;    ///< for tests/fakes/misbehave.hpp
  const char* message;  ///< the only line on stderr, without pids; "": none
  int exit_code;
};

std::vector<std::string> command_for(Start start) {
  const std::vector<std::string> master{test_program("fake_master"), "fake_fluid", "fake_solid", "3"};
  if (start == Start::alone) return master;
  auto words = mpirun();
  words.insert(words.end(), {"-n", "1"});
  words.insert(words.end(), master.begin(), master.end());
  if (start == Start::mpmd)
    words.insert(words.end(), {":", "-n", "1", test_program("fake_fluid"), ":", "-n", "1", test_program("fake_solid")});
  return words;
}

/// "solid (pid 12 on node)" -> "solid", and "solid (/path/fake_solid)" -> "solid"
std::string without_details(const std::string& text) {
  std::string result = text;
  for (auto open = result.find(" ("); open != std::string::npos; open = result.find(" (", open + 1)) {
    const auto close = result.find(')', open);
    const auto inside = result.substr(open, close - open);
    if (inside.find("(pid") != std::string::npos || inside.find('/') != std::string::npos)
      result.erase(open, close - open + 1);
  }
  return result;
}

/// mpirun's exit code is that of whom it sees end first: the master, or the partner that it killed. A master that ends
/// slowly (under the thread sanitizer) may be the second; the front-end does not go by it.
void expect_exit_code(const JobResult& job, int expected, Start start) {
  if (with_thread_sanitizer && start != Start::alone && job.exit_code == 137) return;
  EXPECT_EQ(job.exit_code, expected) << job.errors;
}

/// Open MPI's own lines: where its server is gone before a process that ends slowly (under the thread sanitizer), and,
/// rarely on a busy machine, where mpirun's libevent is told to forget a socket that is closed.
std::string without_lines_of_open_mpi(const std::string& text) {
  std::istringstream lines(text);
  std::string rest;
  for (std::string line; std::getline(lines, line);) {
    const bool is_late = with_thread_sanitizer && line.find("ORTE_ERROR_LOG") != std::string::npos;
    if (!is_late && !line.starts_with("[warn] Epoll ")) rest += line + "\n";
  }
  return rest;
}

class AnyDeath : public ::testing::TestWithParam<Case> {};

TEST_P(AnyDeath, Ends_with_one_message_and_no_orphan) {
  const Case& c = GetParam();
  const bool hangs = std::string(c.fault).find("hang") != std::string::npos;
  Environment environment{{"TETHER_FAKE", c.fault}};
  if (hangs)
    environment["TETHER_START_LIMIT"] = environment["TETHER_SETUP_LIMIT"] = "8";  // a busy machine starts slowly
  const auto job = run_job(command_for(c.start), environment);
  EXPECT_EQ(without_lines_of_open_mpi(without_details(job.errors)),
            c.message[0] == '\0' ? "" : std::string("fake_master: ") + c.message + "\n");
  expect_exit_code(job, c.exit_code, c.start);
  EXPECT_FALSE(job.had_to_be_ended);
  EXPECT_TRUE(job.orphans.empty());
}

constexpr auto before_mpi = "solid ended before it reached MPI", setting_up = "solid died while setting up",
               step_0 = "solid died while computing step 0 (SolidEvaluate)",
               stopping = "solid died while computing step 2 (Stop)",
               fluid_0 = "fluid died while computing step 0 (FluidEvaluate)",
               failed = "solid failed while computing step 0 (SolidEvaluate): element 12 is inverted",
               refused = "solid: case.yaml:7: solid.density: -1 g/cm3: must be positive",
               silent = "solid gave no sign for 8 s while setting up (TETHER_SETUP_LIMIT=SECONDS lets it take longer)",
               too_late = "solid did not reach MPI within 8 s",
               not_started = "MPI did not start within 8 s: a program of the mpirun line did not reach it",
               line_ended = "interrupted while MPI started: a program of the mpirun line ended";

// mpirun's exit code for a killed process is 137, whatever the master returns.
INSTANTIATE_TEST_SUITE_P(
    Fault, AnyDeath,
    ::testing::Values(Case{"alone_none", Start::alone, "", "", 0},
                      Case{"alone_at_start", Start::alone, "solid.kill=start", before_mpi, 1},
                      Case{"alone_setting_up", Start::alone, "solid.kill=hello", setting_up, 1},
                      Case{"alone_computing", Start::alone, "solid.kill=SolidEvaluate", step_0, 1},
                      Case{"alone_fluid", Start::alone, "fluid.kill=FluidEvaluate", fluid_0, 1},
                      Case{"alone_stopping", Start::alone, "solid.kill=Stop", stopping, 1},
                      Case{"alone_early_exit", Start::alone, "solid.exit=start", before_mpi, 1},
                      Case{"alone_exit_in_step", Start::alone, "solid.exit=SolidEvaluate", step_0, 1},
                      Case{"alone_never_appears", Start::alone, "solid.hang=start", too_late, 1},
                      Case{"alone_hangs_setting_up", Start::alone, "solid.hang=hello", silent, 1},
                      Case{"alone_failure", Start::alone, "solid.fail=SolidEvaluate", failed, 1},
                      Case{"alone_input", Start::alone, "solid.refuse=hello", refused, 2},
                      Case{"alone_hangs_leaving", Start::alone, "solid.hang=leave", "", 0},
                      Case{"alone_master", Start::alone, "master.kill=step1", "", 137},
                      Case{"mpirun_none", Start::mpirun, "", "", 0},
                      Case{"mpirun_at_start", Start::mpirun, "solid.kill=start", before_mpi, 137},
                      Case{"mpirun_setting_up", Start::mpirun, "solid.kill=hello", setting_up, 137},
                      Case{"mpirun_computing", Start::mpirun, "solid.kill=SolidEvaluate", step_0, 137},
                      Case{"mpirun_never_appears", Start::mpirun, "solid.hang=start", too_late, 1},
                      Case{"mpirun_input", Start::mpirun, "solid.refuse=hello", refused, 2},
                      Case{"mpirun_master", Start::mpirun, "master.kill=step1", "", 137},
                      Case{"mpmd_none", Start::mpmd, "", "", 0},
                      Case{"mpmd_leaves_late", Start::mpmd, "solid.linger=leave", "", 0},
                      Case{"mpmd_at_start", Start::mpmd, "solid.kill=start", line_ended, 137},
                      Case{"mpmd_setting_up", Start::mpmd, "solid.kill=hello", setting_up, 137},
                      Case{"mpmd_computing", Start::mpmd, "solid.kill=SolidEvaluate", step_0, 137},
                      Case{"mpmd_never_appears", Start::mpmd, "solid.hang=start", not_started, 1},
                      Case{"mpmd_input", Start::mpmd, "solid.refuse=hello", refused, 2},
                      Case{"mpmd_master", Start::mpmd, "master.kill=step1", "", 137}),
    [](const auto& info) { return std::string(info.param.name); });

class Stopped : public ::testing::TestWithParam<Start> {};

/// Told at once, and when it does not go on the run ends as with any other death.
TEST_P(Stopped, APartnerIsToldOfAndEndsTheRunAfterAWhile) {
  const auto job =
      run_job(command_for(GetParam()), {{"TETHER_FAKE", "solid.stop=SolidEvaluate"}, {"TETHER_STOPPED_LIMIT", "4"}});
  const std::string errors = without_lines_of_open_mpi(without_details(job.errors));
  EXPECT_NE(errors.find("fake_master: solid is stopped while computing step 0 (SolidEvaluate): kill -CONT "),
            std::string::npos)
      << errors;
  EXPECT_NE(
      errors.find("fake_master: solid was stopped while computing step 0 (SolidEvaluate), and still is 4 s later"),
      std::string::npos)
      << errors;
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 2) << errors;
  expect_exit_code(job, 1, GetParam());
  EXPECT_FALSE(job.had_to_be_ended);
  EXPECT_TRUE(job.orphans.empty());
}

INSTANTIATE_TEST_SUITE_P(Fault, Stopped, ::testing::Values(Start::alone, Start::mpirun, Start::mpmd));

TEST(Death, APartnerThatIsStoppedWhileItStartsIsToldOf) {
  for (const Start start : {Start::alone, Start::mpirun}) {
    const auto job = run_job(command_for(start), {{"TETHER_FAKE", "solid.stop=start"}, {"TETHER_STOPPED_LIMIT", "4"}});
    const std::string errors = without_lines_of_open_mpi(without_details(job.errors));
    EXPECT_NE(errors.find("fake_master: solid is stopped while starting: kill -CONT "), std::string::npos) << errors;
    EXPECT_NE(errors.find("fake_master: solid was stopped while starting, and still is 4 s later"), std::string::npos)
        << errors;
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 2) << errors;
    EXPECT_EQ(job.exit_code, 1);
    EXPECT_TRUE(job.orphans.empty());
  }
}

/// Nobody waits for a master but its partners: one of them speaks.
TEST(Death, AStoppedMasterIsEndedByItsPartners) {
  const auto job =
      run_job(command_for(Start::mpirun), {{"TETHER_FAKE", "master.stop=step1"}, {"TETHER_STOPPED_LIMIT", "4"}});
  const std::string errors = without_lines_of_open_mpi(without_details(job.errors));
  EXPECT_NE(errors.find(": the master was stopped while at work, and still is 4 s later"), std::string::npos) << errors;
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  EXPECT_NE(job.exit_code, 0);
  EXPECT_FALSE(job.had_to_be_ended);
  EXPECT_TRUE(job.orphans.empty());
}

TEST(Death, Even_what_cleans_up_goes) {
  run_job(command_for(Start::alone), {{"TETHER_FAKE", "solid.kill=SolidEvaluate"}});
  EXPECT_TRUE(nothing_remains());
}

/// Three levels: identification_master, two fsi_masters, two fluids and solids.
std::vector<std::string> groups_command(Start start) {
  const auto program = [](const char* name) { return test_program(name); };
  if (start == Start::alone) return {program("fake_top")};
  auto words = mpirun();
  words.insert(words.end(), {"-n", "1", program("fake_top")});
  if (start == Start::mpmd)
    words.insert(words.end(), {":", "-n", "2", program("fake_group"), ":", "-n", "2", program("fake_fluid"), ":", "-n",
                               "2", program("fake_solid")});
  return words;
}

TEST(Groups, Give_the_same_spawned_or_on_one_line) {
  const auto spawned = run_job(groups_command(Start::mpirun)), one_line = run_job(groups_command(Start::mpmd));
  EXPECT_EQ(spawned.exit_code, 0) << spawned.errors;
  EXPECT_EQ(one_line.exit_code, 0) << one_line.errors;
  EXPECT_NE(spawned.output.find("step 2"), std::string::npos);
  EXPECT_EQ(spawned.output, one_line.output);
  EXPECT_TRUE(spawned.orphans.empty() && one_line.orphans.empty());
}

TEST(Groups, A_death_on_any_level_ends_all_three) {
  for (const Start start : {Start::alone, Start::mpirun, Start::mpmd}) {
    const auto low = run_job(groups_command(start), {{"TETHER_FAKE", "fluid.kill=FluidEvaluate"}});
    EXPECT_EQ(without_details(low.errors),
              "identification_master: fsi_master failed while answering Observe: fluid died while computing step 0 "
              "(FluidEvaluate)\n");
    EXPECT_TRUE(low.orphans.empty());
    EXPECT_FALSE(low.had_to_be_ended);
    const auto middle = run_job(groups_command(start), {{"TETHER_FAKE", "fsi_master.kill=Observe"}});
    EXPECT_EQ(without_details(middle.errors), "identification_master: fsi_master died while answering Observe\n");
    EXPECT_TRUE(middle.orphans.empty());
    EXPECT_FALSE(middle.had_to_be_ended);
  }
}

TEST(Launch, A_missing_or_unusable_program_is_an_input_error) {
  const auto missing = run_job({test_program("fake_master"), "fake_fluid", "no_such_solid", "3"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.errors.find("program of the solid: "), std::string::npos) << missing.errors;
  EXPECT_NE(missing.errors.find("no_such_solid does not exist"), std::string::npos) << missing.errors;
  const auto unusable = run_job({test_program("fake_master"), "/etc/passwd", "fake_solid", "3"});
  EXPECT_EQ(unusable.exit_code, 2);
  EXPECT_EQ(unusable.errors, "fake_master: program of the fluid: /etc/passwd cannot be executed\n");
}

/// Each would have partners enough, and claim the same folder of results.
TEST(Launch, Masters_of_two_runs_on_one_line_are_an_input_error) {
  const std::vector<std::string> master{"-n", "2", test_program("fake_master"), "x", "x", "3"};
  const std::vector<std::string> codes{":", "-n", "2", test_program("fake_fluid"),
                                       ":", "-n", "2", test_program("fake_solid")};
  for (const bool with_codes : {true, false}) {
    auto words = mpirun();
    words.insert(words.end(), master.begin(), master.end());
    if (with_codes) words.insert(words.end(), codes.begin(), codes.end());
    const auto job = run_job(words);
    EXPECT_EQ(job.exit_code, 2);
    EXPECT_EQ(without_lines_of_open_mpi(job.errors),
              "fake_master: the mpirun line has 2 masters that none leads (fake_master), each of which would make a "
              "run: give it one\n");
    EXPECT_EQ(job.output, "");
    EXPECT_TRUE(job.orphans.empty());
    EXPECT_FALSE(job.had_to_be_ended);
  }
}

TEST(Launch, A_program_of_another_role_is_an_input_error) {
  const auto job = run_job({test_program("fake_master"), "fake_solid", "fake_solid", "3"});
  EXPECT_EQ(job.exit_code, 2);
  EXPECT_EQ(without_details(job.errors), "fake_master: fluid says that it is a solid\n");
  EXPECT_TRUE(job.orphans.empty());
}

TEST(Launch, Spawned_and_mpmd_give_the_same_numbers) {
  const auto steps = [](const std::string& output) { return output.substr(output.find("step 0")); };
  const auto alone = run_job(command_for(Start::alone)), mpmd = run_job(command_for(Start::mpmd));
  EXPECT_NE(alone.output.find("step 2"), std::string::npos);
  EXPECT_EQ(steps(alone.output), steps(mpmd.output));
}

}  // namespace
}  // namespace tether::tests
