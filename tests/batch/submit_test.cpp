/// `tether submit` with an sbatch that is a script of the test: what is left of a submission that does not come to its
/// end. With a scheduler: slurm_test.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace submit_test {

namespace fs = std::filesystem;

class Submit : public ::testing::Test {
 protected:
  Submit() {
    folder_.file("model.yaml", fmt::format("base: {}/configs/tube/case.yaml\nname: model\n", TETHER_SOURCE));
    fs::create_directories(folder_ / "bin");
    is_answered_by("squeue", "exit 0");
  }
  void is_answered_by(const std::string& program, const std::string& script) const {
    fs::permissions(folder_.file(fs::path("bin") / program, "#!/bin/sh\n" + script + "\n"), fs::perms::owner_all);
  }
  ChildEnd tether(std::vector<std::string> words,
                  std::vector<std::pair<std::string, std::string>> environment = {}) const {
    words.insert(words.begin(), TETHER_PROGRAM);
    environment.emplace_back("PATH", (folder_ / "bin").string() + ":" + std::getenv("PATH"));
    return capture({words, environment});
  }
  ChildEnd submit(const std::vector<std::string>& more = {},
                  const std::vector<std::pair<std::string, std::string>>& environment = {}) const {
    std::vector<std::string> words{"submit", "simulate", folder_ / "model.yaml", "--output", job(), "--memory", "1G",
                                   "--time", "10"};
    words.insert(words.end(), more.begin(), more.end());
    return tether(words, environment);
  }
  std::string status() const { return tether({"status", job()}).output; }
  std::string job() const { return folder_ / "out"; }

  TemporaryFolder folder_;
};

/// The script of an sbatch that sends a signal to who calls it before it answers.
std::string that_sends(const std::string& signal) {
  return "kill -" + signal + " $PPID; sleep 0.5; echo 7";
}

TEST_F(Submit, InterruptedItTellsTheNumber) {
  is_answered_by("sbatch", that_sends("INT"));
  const ChildEnd end = submit();
  EXPECT_NE(end.errors.find("tether: interrupted; job 7 is submitted: scancel 7 ends it"), std::string::npos)
      << end.errors;
  EXPECT_TRUE(status().starts_with("job 7, simulate, ")) << status();
  const ChildEnd again = submit();
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.errors.find("holds a job; tether status"), std::string::npos) << again.errors;
}

TEST_F(Submit, KilledItLeavesAJobThatIsPerhapsSubmitted) {
  is_answered_by("sbatch", that_sends("KILL"));
  EXPECT_EQ(submit().exit_code, 128 + SIGKILL);
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  const ChildEnd again = submit();
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.errors.find("was perhaps submitted: squeue --me --name=tether-model tells"), std::string::npos)
      << again.errors;
  is_answered_by("sbatch", "kill -9 $$");
  EXPECT_EQ(submit({"--overwrite"}).exit_code, 1);
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  is_answered_by("sbatch", "echo 8");
  EXPECT_EQ(submit({"--overwrite"}).exit_code, 0);
  EXPECT_TRUE(status().starts_with("job 8, simulate, ")) << status();
}

TEST_F(Submit, TellsTheNumberThatItCannotRecord) {
  is_answered_by("sbatch", "echo 7");
  const char* others = std::getenv("LD_PRELOAD");
  const std::string faults = (others == nullptr ? "" : std::string(others) + ":") + TETHER_FAULTS;
  const ChildEnd end = submit(
      {}, {{"LD_PRELOAD", faults}, {"TETHER_FAULT_ROOT", job()}, {"TETHER_FAULT", "tether:write:job.json:2:ENOSPC"}});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("; job 7 is submitted: scancel 7 ends it"), std::string::npos) << end.errors;
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  EXPECT_EQ(submit().exit_code, 2);
}

/// A model stays on one node: what it needs is there, however many nodes there are.
TEST_F(Submit, AsksForWholeModelsOnEachNode) {
  fs::create_directories(folder_ / "cases");
  folder_.file("cases/a.yaml", "base: ../model.yaml\nname: a\n");
  folder_.file("cases/b.yaml", "base: ../model.yaml\nname: b\ncoupling: {ranks: {fluid: 4, solid: 3}}\n");
  const std::vector<std::string> sizes{"--memory", "1G", "--time", "10", "--output", job(), "--dry-run"};
  const auto dry_run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "submit");
    words.insert(words.end(), sizes.begin(), sizes.end());
    return tether(words);
  };
  const ChildEnd all = dry_run({"simulate", folder_ / "cases"});
  EXPECT_NE(all.output.find("--ntasks-per-node=4"), std::string::npos) << "of the case that needs most\n"
                                                                       << all.output << all.errors;
  const ChildEnd wide = dry_run({"simulate", folder_ / "model.yaml", "--nodes", "4"});
  EXPECT_EQ(wide.exit_code, 2);
  EXPECT_EQ(wide.errors, "--nodes: 4: a model stays on one node, and no more than 1 is at work at once\n");
}

TEST_F(Submit, ReservesNoProcessesForOneRun) {
  const ChildEnd end = submit({"--processes", "4"});
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.errors, "--processes: tether simulate makes one run: leave it out\n");
  EXPECT_FALSE(fs::exists(job()));
}

TEST_F(Submit, RefusedItLeavesTheJobThatIsThere) {
  is_answered_by("sbatch", "echo 7");
  ASSERT_EQ(submit().exit_code, 0);
  folder_.file("out/job/ended/model", "0\n"), folder_.file("out/results.csv", "of job 7");
  const std::string before = status();
  is_answered_by("sbatch", "echo 'sbatch: error: no such account' >&2; exit 1");
  const ChildEnd refused = submit({"--overwrite"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("sbatch: error: no such account; the job that was there is kept"), std::string::npos)
      << refused.errors;
  EXPECT_EQ(status(), before);
  EXPECT_TRUE(before.starts_with("job 7, simulate, 1 case: 1 done")) << before;
  EXPECT_TRUE(fs::exists(folder_ / "out/results.csv"));
}

/// At any rename, of what is set aside and of what is put back.
TEST_F(Submit, KilledItLosesNothingOfTheJobThatIsThere) {
  is_answered_by("sbatch", "echo 7");
  ASSERT_EQ(submit().exit_code, 0);
  folder_.file("out/job/ended/model", "0\n"), folder_.file("out/results.csv", "of job 7");
  const std::string before = status();
  is_answered_by("sbatch", "echo 'sbatch: error: no such account' >&2; exit 1");
  const char* others = std::getenv("LD_PRELOAD");
  const std::string faults = (others == nullptr ? "" : std::string(others) + ":") + TETHER_FAULTS;
  int kills = 0;
  for (int nth = 1; nth < 20; ++nth) {
    const ChildEnd end = submit({"--overwrite"}, {{"LD_PRELOAD", faults},
                                                  {"TETHER_FAULT_ROOT", job()},
                                                  {"TETHER_FAULT", fmt::format("tether:rename:-:{}:KILL", nth)}});
    if (end.exit_code != 128 + SIGKILL) break;
    ++kills;
    EXPECT_EQ(submit({"--overwrite"}).exit_code, 2) << "refused by sbatch";
    EXPECT_EQ(status(), before) << "killed at rename " << nth;
    EXPECT_TRUE(fs::exists(folder_ / "out/results.csv")) << "killed at rename " << nth;
  }
  EXPECT_GE(kills, 4) << "job and table, aside and back";
}

/// What a site has wrapped around sbatch may write more than sbatch does.
TEST_F(Submit, TakesTheOneLineThatIsANumber) {
  is_answered_by("sbatch", "echo 'Welcome to Lab cluster, 2 messages'; echo 4712; echo; echo 'Bye: 7 jobs'");
  const ChildEnd end = submit();
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("Job 4712, results in "), std::string::npos) << end.output;
  is_answered_by("squeue", "echo 'N/A|RUNNING|None|0:12|n1'");
  EXPECT_TRUE(status().starts_with("job 4712, simulate, 1 case: 1 running")) << status();
  const ChildEnd again = submit({"--overwrite"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.errors.find("its job 4712 still waits or runs: scancel 4712 ends it"), std::string::npos)
      << again.errors;
}

TEST_F(Submit, WithoutOneNumberItIsPerhapsSubmitted) {
  const std::string many(2000, 'x');
  for (const std::string& said : {std::string("Welcome to Lab cluster"), std::string("4711\n4712"), many,
                                  std::string("Submitted batch job 4711"), std::string("4711;a/b"), std::string()}) {
    fs::remove_all(job());
    is_answered_by("sbatch", "printf '%s\\n' '" + said + "'");
    const ChildEnd end = submit();
    EXPECT_EQ(end.exit_code, 1) << said;
    const std::string words = said == "4711\n4712" ? "4711 4712" : said.substr(0, 100);
    for (const std::string& told :
         {words, std::string("perhaps submitted: squeue --me --name=tether-model tells"), std::string("--overwrite")})
      EXPECT_NE(end.errors.find(told), std::string::npos) << end.errors;
    EXPECT_EQ(std::count(end.errors.begin(), end.errors.end(), '\n'), 1) << end.errors;
    EXPECT_LT(end.errors.size(), 1000U);
    EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << said << ": " << status();
    EXPECT_EQ(submit().exit_code, 2) << said;
  }
}

/// The words of slurm_errno.c.
TEST_F(Submit, ThatLostTheSchedulerHasPerhapsSubmitted) {
  for (const char* error : {"Socket timed out on send/recv operation", "Zero Bytes were transmitted or received",
                            "Unable to contact slurm controller (send failure)",
                            "Unable to contact slurm controller (receive failure)", "Unexpected message received"}) {
    fs::remove_all(job());
    is_answered_by("sbatch", fmt::format("echo 'sbatch: error: Batch job submission failed: {}' >&2; exit 1", error));
    const ChildEnd end = submit();
    EXPECT_EQ(end.exit_code, 1) << error;
    EXPECT_NE(end.errors.find(error), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find("perhaps submitted: squeue --me --name=tether-model tells, and if there is none, "
                              "--overwrite submits it"),
              std::string::npos)
        << end.errors;
    EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
    EXPECT_EQ(submit().exit_code, 2) << error;
  }
  is_answered_by("sbatch", "exit 124");  // of a `timeout` around it
  EXPECT_EQ(submit({"--overwrite"}).exit_code, 1);
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  for (const char* error : {"Invalid partition name specified", "Unable to contact slurm controller (connect failure)",
                            "Invalid account or account/partition combination specified"}) {
    fs::remove_all(job());
    is_answered_by("sbatch", fmt::format("echo 'sbatch: error: Batch job submission failed: {}' >&2; exit 1", error));
    EXPECT_EQ(submit().exit_code, 2) << error;
    EXPECT_TRUE(status().starts_with("job not submitted, simulate, ")) << status();
  }
}

TEST_F(Submit, KeepsANumberThatWasToldBeforeSbatchFailed) {
  for (const char* end_of_sbatch : {"echo 'sbatch: error: Socket timed out on send/recv operation' >&2; exit 1",
                                    "echo 'a plugin failed' >&2; exit 3", "kill -9 $$"}) {
    fs::remove_all(job());
    is_answered_by("sbatch", std::string("echo 4712; ") + end_of_sbatch);
    is_answered_by("squeue", "exit 0");
    const ChildEnd end = submit();
    EXPECT_EQ(end.exit_code, 1) << end.errors;
    EXPECT_NE(end.errors.find("; job 4712 was perhaps submitted: tether status "), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find(" tells, scancel 4712 ends it"), std::string::npos) << end.errors;
    is_answered_by("squeue", "echo 'N/A|PENDING|Resources|0:00|'");
    EXPECT_TRUE(status().starts_with("job 4712, simulate, 1 case: 1 waiting")) << status();
    EXPECT_EQ(submit({"--overwrite"}).exit_code, 2);
  }
}

TEST_F(Submit, ReplacesAJobThatWasPreemptedForGood) {
  is_answered_by("sbatch", "echo 7");
  ASSERT_EQ(submit().exit_code, 0);
  is_answered_by("squeue", "echo 'N/A|PREEMPTED|None|0:12|n1'");
  EXPECT_TRUE(status().starts_with("job 7, simulate, 1 case: 1 gone")) << status();
  is_answered_by("sbatch", "echo 8");
  EXPECT_EQ(submit({"--overwrite"}).exit_code, 0);
  EXPECT_TRUE(status().starts_with("job 8, ")) << status();
}

/// A number is one of its cluster: another may have a job of the same.
TEST_F(Submit, AsksTheClusterWhoseNumberItIs) {
  is_answered_by("sbatch", "echo '4711;other'");
  is_answered_by("squeue",
                 "case \"$*\" in *--clusters=other*) echo CLUSTER: other; echo 'N/A|RUNNING|None|0:12|n1';; "
                 "*) echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1;; esac");
  const ChildEnd end = submit({"--sbatch", "clusters=other"});
  EXPECT_EQ(end.exit_code, 0) << end.errors;
  EXPECT_NE(end.output.find("Job 4711 of cluster other, results in "), std::string::npos) << end.output;
  EXPECT_TRUE(status().starts_with("job 4711 of cluster other, simulate, 1 case: 1 running")) << status();
  const auto refuses_another = [&] {
    const ChildEnd again = submit({"--overwrite"});
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_NE(again.errors.find("its job 4711 of cluster other still waits or runs: scancel -M other 4711 ends it"),
              std::string::npos)
        << again.errors;
  };
  refuses_another();
  for (const char* by_the_script : {"4711\n", "4711;\n", "4711;other\n"}) {
    folder_.file("out/job/number", by_the_script);
    refuses_another();
  }
  folder_.file("out/job/number", "12\n");
  EXPECT_TRUE(status().starts_with("job 12, simulate, ")) << "given to sbatch again, here: " << status();
}

TEST_F(Submit, NamesTheClusterWhereItIsPerhapsSubmitted) {
  is_answered_by("sbatch", "kill -9 $$");
  const ChildEnd end = submit({"--sbatch", "clusters=other"});
  EXPECT_NE(end.errors.find("squeue -M other --me --name=tether-model tells"), std::string::npos) << end.errors;
}

}  // namespace submit_test
}  // namespace tether
