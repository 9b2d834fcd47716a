// What is recorded of a job in its folder, and when another may take its place.
#include "batch/job_folder.hpp"

#include <gtest/gtest.h>

#include "batch/job_script.hpp"
#include "batch/job_status.hpp"
#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/batch/jobs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

TEST_F(Jobs, AreReadBackAsTheyWereWritten) {
  Job written = job(JobVerb::explain, 2);
  written.measured = MeasuredSteps{3, 413, 0.05, 109};
  written.resources = {2, 8, 4, "3G", "1:00:00", "lab", "long", {"qos=high"}};
  write_record(folder_ / "job.json", written);
  EXPECT_EQ(json_of(read_record<Job>(folder_ / "job.json")), json_of(written));
  written.cluster = "other";
  write_record(folder_ / "job.json", written);
  EXPECT_EQ(read_record<Job>(folder_ / "job.json").cluster, "other");
}

TEST_F(Jobs, AreNotReadWithNamesThatNoneHas) {
  Job changed = job(JobVerb::simulate, 2);
  fs::create_directories(folder_ / "job");
  const auto refused = [&] {
    write_record(folder_ / "job/job.json", changed);
    return refusal([&] { read_job(folder_); });
  };
  EXPECT_EQ(refused(), "no error");
  for (const char* name : {"../../base/out/bad", "a/b", "..", "", "a\x1b[2J"}) {
    changed.cases[1].name = name;
    EXPECT_TRUE(refused().starts_with("job/job.json: cases[1].name: '")) << name << refused();
  }
  changed = job(JobVerb::simulate, 2);
  changed.number = "12\n13";
  EXPECT_EQ(refused().substr(0, 26), "job/job.json: number: '12?");
  changed = job(JobVerb::simulate, 2);
  changed.cluster = "a\nb";
  EXPECT_EQ(refused().substr(0, 26), "job/job.json: cluster: 'a?");
  changed.cluster.reset();
  EXPECT_EQ(refused(), "no error");
  write("job/number", "12;a/b\n");
  EXPECT_EQ(refused().substr(0, 27), "job/number: cluster: 'a/b':");
}

TEST_F(Jobs, ReplaceNothingThatIsNotAJob) {
  write("a/results.csv", "mine");
  write("b/job/application.txt", "CV");
  write("c/job/job.json", "{\"of\": \"another program\"}");
  for (const char* folder : {"a", "b", "c"})
    for (const bool overwrite : {false, true}) {
      const std::string refused = refusal([&] { check_replaced(folder_ / folder, overwrite); });
      EXPECT_NE(refused.find("tether submit"), std::string::npos) << folder << ": " << refused;
      EXPECT_NE(refused.find("--output"), std::string::npos) << folder << ": " << refused;
    }
  fs::create_directories(folder_ / "d/job");
  EXPECT_NO_THROW(check_replaced(folder_ / "d", false)) << "an empty folder";
}

TEST_F(Jobs, AreReplacedWhole) {
  write("results.csv", "old"), write("job/ended/old", "0"), write("job/old.log", ""), write("job/number", "9");
  Job unsubmitted = job(JobVerb::simulate, 1);
  unsubmitted.number.clear();
  write_record(folder_ / "job/job.json", unsubmitted);
  fs::remove(folder_ / "job/number");
  check_replaced(folder_, false);
  NewJob(folder_, unsubmitted).keep();
  for (const char* old : {"results.csv", "job/ended/old", "job/old.log"})
    EXPECT_FALSE(fs::exists(folder_ / old)) << old;
  EXPECT_TRUE(fs::is_directory(folder_ / "job/ended"));
  EXPECT_EQ(read_job(folder_).cases.size(), 1U);
}

/// Until the new one is kept, and after a kill in between.
TEST_F(Jobs, ComeBackWhereTheNewOneIsNotKept) {
  write("results.csv", "old"), write("job/ended/case_0", "0"), write("job/number", "9");
  write_record(folder_ / "job/job.json", job(JobVerb::simulate, 1));
  Job other = job(JobVerb::simulate, 2);
  other.number.clear();
  const auto is_old = [&] {
    return read_job(folder_).number == "9" && fs::exists(folder_ / "job/ended/case_0") &&
           fs::exists(folder_ / "results.csv") && !fs::exists(folder_ / ".job_before");
  };
  {
    const NewJob made(folder_, other);
    EXPECT_EQ(read_job(folder_).cases.size(), 2U);
    EXPECT_FALSE(fs::exists(folder_ / "results.csv"));
  }
  EXPECT_TRUE(is_old());
  fs::create_directories(folder_ / ".job_before");
  for (const char* name : {"results.csv", "job"}) fs::rename(folder_ / name, folder_ / ".job_before" / name);
  put_back_job(folder_);
  EXPECT_TRUE(is_old());
  fs::create_directories(folder_ / ".job_before");
  fs::rename(folder_ / "job", folder_ / ".job_before/job"),
      fs::rename(folder_ / "results.csv", folder_ / ".job_before/results.csv");
  fs::create_directories(folder_ / "job");
  write_record(folder_ / "job/job.json", other);
  write("job/submission_begun", "");
  put_back_job(folder_);
  EXPECT_EQ(read_job(folder_).cases.size(), 2U) << "perhaps submitted";
  fs::remove(folder_ / "job/submission_begun");
  put_back_job(folder_);
  EXPECT_TRUE(is_old());
}

/// The job is set aside first, and put back last.
TEST_F(Jobs, LoseNoTableWhereAKillComesBetweenTwoRenames) {
  write("results.csv", "old"), write("job/number", "9");
  write_record(folder_ / "job/job.json", job(JobVerb::simulate, 1));
  const fs::path aside = folder_ / ".job_before";
  fs::create_directories(aside);
  fs::rename(folder_ / "job", aside / "job");
  EXPECT_NO_THROW(check_replaced(folder_, false)) << "the table is the job's";
  write(".job_before/results.csv", "old");
  EXPECT_THROW(check_replaced(folder_, false), InputError) << "the table is somebody's";
  fs::remove(aside / "results.csv");
  put_back_job(folder_);
  EXPECT_EQ(read_job(folder_).number, "9");
  EXPECT_TRUE(fs::exists(folder_ / "results.csv"));
  EXPECT_FALSE(fs::exists(aside));
}

TEST_F(Jobs, ThatArePerhapsSubmittedAreNotSubmittedAgain) {
  Job one = job(JobVerb::simulate, 1);
  one.number.clear();
  write("job/submission_begun", "");
  write_record(folder_ / "job/job.json", one);
  const std::string refused = refusal([&] { check_replaced(folder_, false); });
  EXPECT_NE(refused.find(": holds a job that was perhaps submitted: squeue --me --name=tether-case_0 tells; scancel "
                         "ends it, --output makes another, --overwrite replaces it"),
            std::string::npos)
      << refused;
  EXPECT_NO_THROW(check_replaced(folder_, true));
  EXPECT_EQ(status_of(one, folder_, std::nullopt).front().state, CaseState::unknown);
  write("job/number", "12\n");
  EXPECT_EQ(status_of(read_job(folder_), folder_, std::vector<slurm::Task>()).front().state, CaseState::gone)
      << "its script has told the number";
}

TEST_F(Jobs, AreReplacedWhereTheirRecordIsDamagedIfThatIsWanted) {
  write("job/job.json", "{\"verb\": "), write("job/script.sh", ""), write("job/ended/a", "0");
  const std::string refused = refusal([&] { check_replaced(folder_, false); });
  EXPECT_NE(refused.find("--overwrite replaces it"), std::string::npos) << refused;
  EXPECT_NO_THROW(check_replaced(folder_, true));
}

TEST_F(Jobs, ReplaceNothingThatTheyRead) {
  const fs::path in_job = write("job/cases/a.yaml", "name: a\n"), table = write("results.csv", "name\na\n");
  const fs::path beside = write("b.yaml", "name: b\nbase: job/cases/a.yaml\n");
  const fs::path own = write("c/case.yaml", "name: c\n"), free = write("d.yaml", "name: d\n");
  const auto refused = [&](const std::string& name, const fs::path& file, const fs::path& read) {
    return refusal([&] { check_keeps_read(folder_, {{name, file.string()}}, {read}); });
  };
  EXPECT_NE(refused("a", in_job, free).find("a.yaml: is read"), std::string::npos) << refused("a", in_job, free);
  EXPECT_NE(refused("b", beside, free).find("a.yaml: is read"), std::string::npos) << refused("b", beside, free);
  EXPECT_NE(refused("c", own, free).find("case.yaml: is read"), std::string::npos) << refused("c", own, free);
  EXPECT_NE(refused("d", free, table).find("results.csv: is read"), std::string::npos) << refused("d", free, table);
  EXPECT_EQ(refused("d", free, free), "no error");
}

}  // namespace
}  // namespace tether
