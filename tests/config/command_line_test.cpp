#include "common/config/command_line.hpp"

#include "common/config/describe.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace {

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(std::vector<std::string> arguments, const std::function<int(const CommandLine&)>& body,
            bool shares_work = false) {
  Program program;
  program.name = "pump";
  program.purpose = "moves blood";
  program.declare = [](Fields& f) {
    TimeCase sample;
    f.group("fluid", sample, "the blood");
  };
  program.validate = [](const CommandLine& c) { CaseFile(c.case_file).finish(); };
  program.run = body;
  program.shares_work = program.shares_runs = shares_work;
  arguments.insert(arguments.begin(), "pump");
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const int code = run_main(static_cast<int>(argv.size()), argv.data(), program);
  const std::string out = ::testing::internal::GetCapturedStdout();
  return {code, out, ::testing::internal::GetCapturedStderr()};
}

int never(const CommandLine&) {
  ADD_FAILURE() << "must not run";
  return exit_run_failed;
}

TEST(CommandLine, HandsOverWhatWasTyped) {
  const std::string file = write_file("case.yaml", valid_head).string();
  CommandLine typed;
  const auto keep = [&](const CommandLine& c) {
    typed = c;
    return 0;
  };
  EXPECT_EQ(
      run({file, "--output", "o", "--steps", "7", "--processes", "2", "--runs", "r", "--resume", "--quiet"}, keep, true)
          .code,
      exit_done);
  EXPECT_EQ(typed.case_file, file);
  EXPECT_EQ(typed.output, "o");
  EXPECT_EQ(typed.steps, 7);
  EXPECT_EQ(typed.processes, 2);
  EXPECT_EQ(typed.runs, "r");
  EXPECT_TRUE(typed.resume && typed.quiet && !typed.overwrite && !typed.validate);
}

/// As of a script whose variable has no value: it would work in the default folder.
TEST(CommandLine, RefusesAnOutputFolderWithoutAName) {
  const std::string file = write_file("case.yaml", valid_head).string();
  const Outcome outcome = run({file, "--output", ""}, never);
  EXPECT_EQ(outcome.code, exit_input_wrong);
  EXPECT_NE(outcome.err.find("--output: '': must name a folder"), std::string::npos) << outcome.err;
}

TEST(CommandLine, NamesANumberOfStepsThatIsNone) {
  const std::string file = write_file("case.yaml", valid_head).string();
  for (const char* number : {"0", "-3", "1.5", "x"}) {
    const Outcome end = run({file, std::string("--steps=") + number}, never);
    EXPECT_EQ(end.code, exit_input_wrong);
    EXPECT_NE(end.err.find(std::string("--steps: ") + number + ": must be a whole number, at least 1"),
              std::string::npos)
        << end.err;
  }
}

TEST(CommandLine, TellsWrongInputFromAFailedRun) {
  const std::string file = write_file("case.yaml", valid_head).string();
  const auto input = run({file}, [](const CommandLine&) -> int { throw InputError("case.yaml:3: no"); });
  EXPECT_EQ(input.code, exit_input_wrong);
  EXPECT_EQ(input.err, "case.yaml:3: no\n");
  const auto failed = run({file}, [](const CommandLine&) -> int { throw RunError("step 3 does not converge"); });
  EXPECT_EQ(failed.code, exit_run_failed);
  EXPECT_EQ(failed.err, "pump: step 3 does not converge\n");
}

TEST(CommandLine, ValidatesWithoutRunning) {
  const std::string file = write_file("case.yaml", valid_head).string();
  const auto valid = run({file, "--validate"}, never);
  EXPECT_EQ(valid.code, exit_done);
  EXPECT_EQ(valid.out, file + ": valid for pump\n");
  const std::string wrong = write_file("wrong.yaml", "name: a\n").string();
  EXPECT_EQ(run({wrong, "--validate"}, never).code, exit_input_wrong);
}

TEST(CommandLine, DescribesWithoutACase) {
  const auto text = run({"--describe-config"}, never);
  EXPECT_EQ(text.code, exit_done);
  EXPECT_NE(text.out.find("fluid.step [s]  (number; must be given; must be positive)"), std::string::npos);
  EXPECT_NE(run({"--describe-config", "markdown"}, never).out.find("## fluid"), std::string::npos);
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run({}, never).code, exit_input_wrong);
  EXPECT_EQ(run({"case.yaml", "--sped"}, never).code, exit_input_wrong);
  EXPECT_EQ(run({"case.yaml", "--steps", "-1"}, never).code, exit_input_wrong);
  EXPECT_EQ(run({"case.yaml", "--processes", "2"}, never).code, exit_input_wrong) << "a program that shares no work";
  EXPECT_EQ(run({"none.yaml", "--validate"}, never).err, "none.yaml: no such file\n");
  EXPECT_EQ(run({"--help"}, never).code, exit_done);
}

}  // namespace
}  // namespace tether
