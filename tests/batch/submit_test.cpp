/// `tether submit` with an sbatch that is a script of the test: what is left of a submission that does not come to its
/// end. With a scheduler: slurm_test.py.
#include <gtest/gtest.h>

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
  /// before: what runs tether.
  ChildEnd tether(std::vector<std::string> words, const std::vector<std::string>& before = {},
                  std::vector<std::pair<std::string, std::string>> environment = {}) const {
    words.insert(words.begin(), TETHER_PROGRAM);
    words.insert(words.begin(), before.begin(), before.end());
    environment.emplace_back("PATH", (folder_ / "bin").string() + ":" + std::getenv("PATH"));
    return capture({words, environment});
  }
  ChildEnd submit(const std::vector<std::string>& before = {}, const std::vector<std::string>& more = {},
                  const std::vector<std::pair<std::string, std::string>>& environment = {}) const {
    std::vector<std::string> words{"submit", "simulate", folder_ / "model.yaml", "--output", job(), "--memory", "1G",
                                   "--time", "10"};
    words.insert(words.end(), more.begin(), more.end());
    return tether(words, before, environment);
  }
  std::string status() const { return tether({"status", job()}).output; }
  std::string job() const { return folder_ / "out"; }

  TemporaryFolder folder_;
};

constexpr const char* slow = "sleep 2; echo 7";

TEST_F(Submit, InterruptedItTellsTheNumber) {
  is_answered_by("sbatch", slow);
  const ChildEnd end = submit({"timeout", "-s", "INT", "1"});
  EXPECT_NE(end.errors.find("tether: interrupted; job 7 is submitted: scancel 7 ends it"), std::string::npos)
      << end.errors;
  EXPECT_TRUE(status().starts_with("job 7, simulate, ")) << status();
  const ChildEnd again = submit();
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.errors.find("holds a job; tether status"), std::string::npos) << again.errors;
}

TEST_F(Submit, KilledItLeavesAJobThatIsPerhapsSubmitted) {
  is_answered_by("sbatch", slow);
  submit({"timeout", "-s", "KILL", "1"});
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  const ChildEnd again = submit();
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.errors.find("was perhaps submitted: squeue --me --name=tether-model tells"), std::string::npos)
      << again.errors;
  is_answered_by("sbatch", "kill -9 $$");
  EXPECT_EQ(submit({}, {"--overwrite"}).exit_code, 1);
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  is_answered_by("sbatch", "echo 8");
  EXPECT_EQ(submit({}, {"--overwrite"}).exit_code, 0);
  EXPECT_TRUE(status().starts_with("job 8, simulate, ")) << status();
}

TEST_F(Submit, TellsTheNumberThatItCannotRecord) {
  is_answered_by("sbatch", "echo 7");
  const char* others = std::getenv("LD_PRELOAD");
  const std::string faults = (others == nullptr ? "" : std::string(others) + ":") + TETHER_FAULTS;
  const ChildEnd end = submit(
      {}, {},
      {{"LD_PRELOAD", faults}, {"TETHER_FAULT_ROOT", job()}, {"TETHER_FAULT", "tether:write:job.json:2:ENOSPC"}});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find("; job 7 is submitted: scancel 7 ends it"), std::string::npos) << end.errors;
  EXPECT_TRUE(status().starts_with("job perhaps submitted, simulate, ")) << status();
  EXPECT_EQ(submit().exit_code, 2);
}

TEST_F(Submit, RefusedItLeavesTheJobThatIsThere) {
  is_answered_by("sbatch", "echo 7");
  ASSERT_EQ(submit().exit_code, 0);
  folder_.file("out/job/ended/model", "0\n"), folder_.file("out/results.csv", "of job 7");
  const std::string before = status();
  is_answered_by("sbatch", "echo 'sbatch: error: no such account' >&2; exit 1");
  const ChildEnd refused = submit({}, {"--overwrite"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("sbatch: error: no such account; the job that was there is kept"), std::string::npos)
      << refused.errors;
  EXPECT_EQ(status(), before);
  EXPECT_TRUE(before.starts_with("job 7, simulate, 1 case: 1 done")) << before;
  EXPECT_TRUE(fs::exists(folder_ / "out/results.csv"));
}

}  // namespace submit_test
}  // namespace tether
