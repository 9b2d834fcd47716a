// Jobs without a scheduler: which cases, what is asked for, the script, what is said of them. With one: slurm_test.py.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "batch/job_cases.hpp"
#include "batch/job_folder.hpp"
#include "batch/job_plan.hpp"
#include "batch/job_results.hpp"
#include "batch/job_script.hpp"
#include "batch/job_status.hpp"
#include "common/base/child_process.hpp"
#include "common/base/error.hpp"
#include "common/base/shell_quoted.hpp"
#include "common/config/case_tree.hpp"
#include "common/io/record_file.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"
#include "tests/batch/jobs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_of(const std::vector<JobCase>& cases) {
  std::vector<std::string> names;
  for (const JobCase& one : cases) names.push_back(one.name);
  return names;
}

TEST_F(Jobs, HaveTheCasesOfAFolderByName) {
  write("patients/zoe.yaml", "");
  write("patients/adam/case.yaml", "");
  write("patients/adam/lumen.csv", "");
  write("patients/notes.txt", "");
  EXPECT_EQ(names_of(job_cases(folder_ / "patients")), (std::vector<std::string>{"adam", "zoe"}));
  EXPECT_EQ(job_cases(folder_ / "patients/adam/case.yaml").front().name, "adam");
  EXPECT_EQ(job_cases(folder_ / "patients/zoe.yaml").front().case_file, (folder_ / "patients/zoe.yaml").string());
}

TEST_F(Jobs, RefuseFoldersWithoutCasesAndNamesThatCannotBeFolders) {
  write("none/notes.txt", "");
  write("twice/adam.yaml", "");
  write("twice/adam/case.yaml", "");
  write("odd/a b$.yaml", "");
  write("own/job.yaml", "");
  const auto refused = [&](const char* name) { return refusal([&] { job_cases(folder_ / name); }); };
  EXPECT_EQ(refused("none"), "none: holds no case: no NAME.yaml, and no NAME/case.yaml");
  EXPECT_EQ(refused("absent"), "absent: no such file or folder");
  EXPECT_EQ(refused("twice"), "twice: two cases have the name 'adam'");
  EXPECT_NE(refused("odd").find("'a b$' is to be a folder of results"), std::string::npos) << refused("odd");
  EXPECT_EQ(refused("own"), "own: no case may have the name 'job'");
  write("table/results.csv.yaml", "");
  EXPECT_EQ(refused("table"), "table: no case may have the name 'results.csv'");
}

TEST_F(Jobs, MakeACaseOfEachRowOfATable) {
  const fs::path base = write("tube.yaml", "name: tube\nsolid: {material: {young: 4e6, poisson: 0.45}}\n");
  const fs::path table =
      write("walls.csv", "name, solid.material.young [kPa], time.end\nsoft, 200, \nstiff, 900, 0.5\n");
  const auto cases = job_cases_of_table(base, table, folder_ / "cases");
  ASSERT_EQ(names_of(cases), (std::vector<std::string>{"soft", "stiff"}));
  const YamlNode soft = read_case_tree(cases[0].case_file), stiff = read_case_tree(cases[1].case_file);
  EXPECT_EQ(soft.find("name")->text, "soft");
  EXPECT_EQ(soft.find("solid")->find("material")->find("young")->text, "200 kPa");
  EXPECT_EQ(soft.find("solid")->find("material")->find("poisson")->text, "0.45") << "of the base";
  EXPECT_EQ(soft.find("time"), nullptr) << "an empty cell says nothing";
  EXPECT_EQ(stiff.find("time")->find("end")->text, "0.5");
  EXPECT_EQ(refusal([&] { job_cases_of_table(base, write("twice.csv", "name,a,a\nx,,1\n"), folder_ / "cases"); }),
            "twice.csv:1: has two columns 'a': leave one of them out");
  EXPECT_EQ(refusal([&] { job_cases_of_table(base, write("no_name.csv", "young\n1\n"), folder_ / "cases"); }),
            "no_name.csv: has no column `name`, one for each case");
}

TEST_F(Jobs, TakeCellsOfATableAsTheyAre) {
  const fs::path base = write("tube.yaml", "name: tube\n");
  const std::vector<std::string> texts{"patient # 3", "~", "x: y # {", "it's", "- a", "null", "a\\b", "&a", "---"};
  std::string rows = "name, title\n";
  for (std::size_t k = 0; k < texts.size(); ++k) rows += fmt::format("c{}, {}\n", k, texts[k]);
  const auto cases = job_cases_of_table(base, write("t.csv", rows), folder_ / "cases");
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const YamlNode tree = read_case_tree(cases[k].case_file);
    EXPECT_EQ(tree.find("title")->kind, YamlNode::Kind::scalar) << texts[k];
    EXPECT_EQ(tree.find("title")->text, texts[k]);
  }
  const fs::path lists = write("lists.csv", "name, a, b [mm]\nx, [5], 0.05 # x\ny, {c: [1]},\n");
  const auto with_lists = job_cases_of_table(base, lists, folder_ / "cases");
  const YamlNode x = read_case_tree(with_lists[0].case_file), y = read_case_tree(with_lists[1].case_file);
  EXPECT_EQ(x.find("a")->items.at(0).text, "5");
  EXPECT_EQ(x.find("b")->text, "0.05 # x mm") << "the case refuses it";
  EXPECT_EQ(y.find("a")->find("c")->items.at(0).text, "1");
}

/// Beside the case that all build on, as that has them; the cases of a table stand elsewhere.
TEST_F(Jobs, FindFilesOfATableBesideItsCase) {
  const fs::path base = write("tube.yaml", "name: tube\n");
  write("flow.csv", "t\n"), write("flow", "t\n"), write("1.5", "t\n");
  const fs::path table = write("t.csv", "name, a, b\nx, flow.csv, flow\ny, ./flow.csv, 1.5\nz, none.csv,\n");
  const auto cases = job_cases_of_table(base, table, folder_ / "cases");
  const auto value = [&](int row, const char* field) {
    return read_case_tree(cases[static_cast<std::size_t>(row)].case_file).find(field)->text;
  };
  for (const int row : {0, 1}) EXPECT_TRUE(fs::equivalent(value(row, "a"), folder_ / "flow.csv")) << value(row, "a");
  EXPECT_EQ(value(0, "b"), "flow") << "a word";
  EXPECT_EQ(value(1, "b"), "1.5") << "a number";
  EXPECT_EQ(value(2, "a"), "none.csv");
  EXPECT_EQ(told_by_row(cases[2], "a: " + (folder_ / "cases/none.csv").string() + ": no such file"),
            (folder_ / "t.csv:4: a: none.csv: no such file").string());
}

TEST_F(Jobs, NameTheRowOfATableThatIsWrong) {
  const fs::path base = write("tube.yaml", "name: tube\n");
  const auto refused = [&](const std::string& rows) {
    return refusal([&] { job_cases_of_table(base, write("t.csv", rows), folder_ / "cases"); });
  };
  for (const char* cell : {"[5] # x", "[5] x", "[5]] [6", "[5] ]", "{a: 1} x"})
    EXPECT_EQ(refused(fmt::format("name, a\nx, [1]\ny, {}\n", cell)).substr(0, 10), "t.csv:3: a") << cell;
  EXPECT_EQ(refused("name, a [mm]\nx, [1]\n"), "t.csv:2: a: '[1]': must be one number: the column has a unit, mm");
  EXPECT_EQ(refused("name, ..\nx, 1\n"), "t.csv:2: '..': a name is missing beside a dot");
  EXPECT_EQ(refused("name, a, a.b\nx, 1, 2\n"), "t.csv:2: a.b: is given twice, or lies within a field that is");
  EXPECT_EQ(refused("name, base\nx, b.yaml\n"),
            "t.csv: has a column `base`: all its cases build on the case that is given");
  EXPECT_EQ(refused("name, a\nx, 1\nx, 2\n"), "t.csv:3: two cases have the name 'x'");
  const JobCase one{"a", "/job/cases/a.yaml", "t.csv:2"};
  EXPECT_EQ(told_by_row(one, "/job/cases/a.yaml:5: young: -4e6: must be positive\nbase.yaml:3: b: unknown field"),
            "t.csv:2: young: -4e6: must be positive\nt.csv:2: base.yaml:3: b: unknown field");
  EXPECT_EQ(told_by_row({"a", "/a.yaml"}, "/a.yaml:5: wrong"), "/a.yaml:5: wrong");
}

TEST_F(Jobs, AskForTwiceTheTimeThatAFewStepsFortell) {
  const MeasuredSteps measured{3, 400, 0.5, 1000}, coarser{3, 200, 0.1, 400};
  const auto planned = [&](JobVerb verb, int processes, int parameters) {
    PlannedRuns runs = planned_runs(verb, parameters);
    runs.model = measured;
    runs.processes = processes;
    return runs;
  };
  EXPECT_DOUBLE_EQ(expected_time(planned(JobVerb::simulate, 1, 0)).most, 200);
  const PlannedRuns identification = planned(JobVerb::identify, 4, 11);
  EXPECT_DOUBLE_EQ(expected_time(identification).most, 600) << "12 particles, 4 at once";
  PlannedRuns diagnosis = planned(JobVerb::diagnose, 4, 0);
  EXPECT_DOUBLE_EQ(expected_time(diagnosis).least, 1200) << "what takes as long as 24 runs, 4 at once";
  EXPECT_DOUBLE_EQ(expected_time(diagnosis).most, 4600) << "91 runs";
  diagnosis.cores = 2;
  EXPECT_DOUBLE_EQ(expected_time(diagnosis).most, 9200) << "two cores do no more than two at once";
  diagnosis.cores = 0;
  diagnosis.first_order = 40;
  EXPECT_DOUBLE_EQ(expected_time(diagnosis).least, 1200 + 2000) << "and 40 of each number";
  diagnosis.coarser = coarser;
  EXPECT_DOUBLE_EQ(expected_time(diagnosis).least, 1200 + 200) << "of the coarser model";
  EXPECT_DOUBLE_EQ(expected_memory(diagnosis, 1), 1.25 * 4 * 1000 + 400);
  EXPECT_DOUBLE_EQ(expected_memory(diagnosis, 3), 1.25 * 2 * 1000 + 400) << "a model stays on one node";
  diagnosis.finer = {{3, 800, 0.5, 1000}, {3, 400, 2, 3000}};
  EXPECT_DOUBLE_EQ(expected_time(diagnosis).least, 1200 + 200 + 400 + 800) << "and each finer model once";
  EXPECT_DOUBLE_EQ(expected_memory(diagnosis, 1), 1.25 * 4 * 3000 + 400) << "whose processes are as many";
  EXPECT_GT(expected_time(planned(JobVerb::explain, 4, 0)).most, 4600);
  JobResources asked{2, 4, 2, "", "", "", "", {}};
  fill_from(identification, asked);
  EXPECT_EQ(asked.memory, "2900M") << "half of 4 x 1000 MB and a quarter, and 400 MB for the rest";
  EXPECT_EQ(asked.time, "0:30:00") << "2 x 10 min and 10 min";
  JobResources given{1, 1, 1, "8G", "5", "", "", {}};
  fill_from(identification, given);
  EXPECT_EQ(given.memory + " " + given.time, "8G 5");
}

/// What bash says of it; nothing if it is right.
std::string complaint_of_bash(const fs::path& script) {
  return capture({{"bash", "-n", script.string()}, {}}).errors;
}

TEST_F(Jobs, AreScriptsThatBashUnderstandsWhateverNamesHold) {
  for (const auto& [verb, word, meaning] : words_of<JobVerb>)
    for (const int cases : {1, 3}) {
      Job one = job(verb, cases);
      one.resources.more = {"qos=high"};
      const std::string text = job_script(one, folder_);
      EXPECT_EQ(complaint_of_bash(write("script.sh", text)), "") << word;
      EXPECT_EQ(text.find("#SBATCH --array=0-2") != std::string::npos, cases == 3);
      EXPECT_NE(text.find("#SBATCH --qos=high\n"), std::string::npos);
      EXPECT_EQ(text.find("echo --resume") != std::string::npos, is_resumed(verb));
      EXPECT_EQ(text.find("options='--processes 1'") != std::string::npos, makes_many_runs(verb));
    }
  EXPECT_EQ(capture({{"bash", "-c", "printf %s " + shell_quoted("it's $HOME")}, {}}).output, "it's $HOME");
}

TEST_F(Jobs, RefuseWhatSbatchWouldTakeForSomethingElse) {
  for (const char* name : {"it's", "a b", "50%j", "a\\b", "$HOME"})
    EXPECT_NE(refusal([&] { job_script(job(JobVerb::simulate, 1), folder_ / name); }).find("sbatch takes no folder"),
              std::string::npos)
        << name;
  const auto refused = [&](const JobResources& r) { return refusal([&] { check_resources(r); }); };
  JobResources good{1, 1, 1, "8G", "2:30:00", "lab_1", "long", {"qos=high"}};
  EXPECT_EQ(refused(good), "no error");
  for (const char* time : {"30", "30:00", "120:00", "1-12", "1-12:30:00", "365-0", "0"}) {
    good.time = time;
    EXPECT_EQ(refused(good), "no error") << time;
  }
  for (const char* time :
       {"5", "5:59", "0:05:00", "-5", "soon", "20\nrm x", "1:99:99", "30:60", "1-2:60", "400-0", "99999999999:00:00"}) {
    JobResources r;
    r.time = time;
    EXPECT_NE(refused(r).find("--time"), std::string::npos) << time;
  }
  JobResources r;
  r.memory = "1G\n#SBATCH --time=1";
  EXPECT_NE(refused(r).find("--memory"), std::string::npos);
  for (const char* memory : {"8X", "1e99G", "-1G", "1.5G", "G", "8GB", "99999999999G", "2", "900K"}) {
    r.memory = memory;
    EXPECT_NE(refused(r).find("--memory"), std::string::npos) << memory;
  }
  for (const char* memory : {"0", "8000", "8G", "500M", "2T", "900000K"}) {
    r.memory = memory;
    EXPECT_EQ(refused(r), "no error") << memory;
  }
  r = {}, r.account = "my lab";
  EXPECT_NE(refused(r).find("--account"), std::string::npos);
  r = {}, r.more = {"--qos=high"};
  EXPECT_NE(refused(r).find("--sbatch"), std::string::npos) << "without dashes";
}

TEST_F(Jobs, TellWhatBecameOfEachCase) {
  const Job five = job(JobVerb::simulate, 5);
  write("job/case_0.log", "[##] step 2/9\nTo continue: tether simulate\n");
  write("job/ended/case_2", "0\n");
  write("job/ended/case_3", "1\n");
  write("job/case_3.log", "fluid: out of memory\nThe state after 3 steps is in here\nTo continue: tether simulate\n");
  write("job/ended/case_1", "1\n");  // of its first start
  const std::vector<slurm::Task> tasks{{0, "RUNNING", "", "0:12", "n1"},
                                       {1, "PENDING", "BeginTime", "0:00", ""},
                                       {2, "COMPLETED", "", "0:20", "n1"},
                                       {4, "CANCELLED", "", "0:01", "n1"}};
  const std::vector<CaseStatus> all = status_of(five, folder_, tasks);
  const std::vector<CaseState> states{CaseState::running, CaseState::waiting, CaseState::done, CaseState::failed,
                                      CaseState::gone};
  for (std::size_t k = 0; k < states.size(); ++k) EXPECT_EQ(all[k].state, states[k]) << k;
  EXPECT_EQ(all[0].note, "0:12 on n1: [##] step 2/9");
  EXPECT_EQ(all[1].note, "BeginTime");
  EXPECT_EQ(all[3].note, "fluid: out of memory");
  EXPECT_EQ(all[4].note, "CANCELLED");
  const std::vector<CaseStatus> unasked = status_of(five, folder_, std::nullopt);
  EXPECT_EQ(unasked[0].state, CaseState::unknown);
  EXPECT_EQ(unasked[2].state, CaseState::done) << "as its folder says";
  EXPECT_EQ(text_of(all).substr(0, text_of(all).find('\n')), "5 cases: 1 waiting, 1 running, 1 done, 1 failed, 1 gone");
  EXPECT_NE(text_of({{"a", CaseState::failed, "no\x1b[2Jthing"}}).find(" no?[2Jthing\n"), std::string::npos);
  EXPECT_EQ((JobResults{{"case", "state", "b\x1b[2J"}, {{"a", "done", "1"}}}.text().find('\x1b')), std::string::npos);
  Job unsubmitted = five;
  unsubmitted.number.clear();
  EXPECT_EQ(status_of(unsubmitted, folder_, std::nullopt).front().state, CaseState::unsubmitted);
}

/// JOB STATE CODES of squeue's manual.
TEST_F(Jobs, HaveAllStatesThatSlurmHas) {
  const Job one = job(JobVerb::simulate, 1);
  const auto told = [&](const char* state) {
    return status_of(one, folder_, std::vector<slurm::Task>{{0, state, "why", "0:12", "n1"}}).front();
  };
  for (const char* ended : {"BOOT_FAIL", "CANCELLED", "COMPLETED", "DEADLINE", "FAILED", "NODE_FAIL", "OUT_OF_MEMORY",
                            "PREEMPTED", "REVOKED", "TIMEOUT"}) {
    EXPECT_EQ(told(ended).state, CaseState::gone) << ended;
    EXPECT_EQ(told(ended).note, ended);
    EXPECT_TRUE(slurm::has_ended({0, ended, "", "", ""})) << ended;
  }
  for (const char* waits :
       {"CONFIGURING", "REQUEUED", "REQUEUE_FED", "REQUEUE_HOLD", "RESV_DEL_HOLD", "SPECIAL_EXIT"}) {
    EXPECT_EQ(told(waits).state, CaseState::waiting) << waits;
    EXPECT_EQ(told(waits).note, std::string(waits) + ": why");
  }
  for (const char* runs : {"COMPLETING", "RESIZING", "SIGNALING", "STAGE_OUT", "STOPPED", "SUSPENDED"}) {
    EXPECT_EQ(told(runs).state, CaseState::running) << runs;
    EXPECT_EQ(told(runs).note, std::string(runs) + ": 0:12 on n1");
  }
  EXPECT_EQ(told("PENDING").note, "why");
  EXPECT_EQ(told("RUNNING").note, "0:12 on n1");
  EXPECT_EQ(told("OF_A_LATER_SLURM").state, CaseState::unknown);
  EXPECT_EQ(told("OF_A_LATER_SLURM").note, "OF_A_LATER_SLURM");
  EXPECT_FALSE(slurm::has_ended({0, "OF_A_LATER_SLURM", "", "", ""}));
}

/// By the script itself, whoever gives it to sbatch.
TEST_F(Jobs, TellTheirNumberAndTheClusterThatWasAskedFor) {
  Job one = job(JobVerb::diagnose, 1);
  one.program = "/bin/true";
  const auto told = [&](const std::vector<std::string>& more, const std::string& environment) {
    one.resources.more = more;
    fs::create_directories(folder_ / "job/ended");
    const fs::path script = write("job/script.sh", job_script(one, folder_));
    write_record(folder_ / "job/job.json", one);
    capture({{"env", "-u", "SLURM_ARRAY_JOB_ID", "-u", "SBATCH_CLUSTERS", "SLURM_CLUSTERS=" + environment,
              "SLURM_JOB_ID=4711", "SLURM_CLUSTER_NAME=other", "bash", script.string()},
             {}});
    return told_number(read_job(folder_));
  };
  EXPECT_EQ(told({"qos=high"}, ""), "4711");
  EXPECT_EQ(told({"clusters=other,third"}, ""), "4711 of cluster other");
  EXPECT_EQ(told({}, "all"), "4711 of cluster other");
}

/// To open a pipe waits without end, and a device has none.
TEST_F(Jobs, AreToldWhateverStandsInThePlaceOfTheirFiles) {
  const Job two = job(JobVerb::simulate, 2);
  write("job/ended/case_0", "1\n");
  write_record(folder_ / "job/job.json", two);
  const auto refused = [&] { return refusal([&] { status_of(read_job(folder_), folder_, std::nullopt); }); };
  fs::create_symlink("/dev/zero", folder_ / "job/number");
  EXPECT_EQ(refused(), "job/number: is not a file");
  fs::remove(folder_ / "job/number");
  write("job/number", std::string(5'000'000, '1'));
  EXPECT_TRUE(refused().starts_with("job/number: has 5 MB: larger than ")) << refused();
  write("job/number", "12\n");
  ASSERT_EQ(mkfifo((folder_ / "job/case_0.log").c_str(), 0600), 0);
  const std::string log = (folder_ / "job/case_0.log").string();
  EXPECT_EQ(status_of(two, folder_, std::nullopt)[0].note, log + ": is not a file");
  ASSERT_EQ(mkfifo((folder_ / "job/ended/case_1").c_str(), 0600), 0);
  const auto unreadable = [&] {
    const std::vector<CaseStatus> all = status_of(read_job(folder_), folder_, std::nullopt);
    EXPECT_EQ(all[0].state, CaseState::failed) << "what another case left is no matter of this one";
    EXPECT_EQ(all[1].state, CaseState::unknown);
    return all[1].note;
  };
  const fs::path ended = folder_ / "job/ended/case_1";
  EXPECT_EQ(unreadable(), ended.string() + ": is not a file");
  fs::remove(ended);
  fs::create_directory(ended);
  EXPECT_EQ(unreadable(), ended.string() + ": is not a file");
  fs::remove(ended);
  fs::create_symlink(ended, ended);
  EXPECT_EQ(unreadable(), ended.string() + ": no such file") << "a link to itself";
}

TEST_F(Jobs, HaveOneTableOfTheirResults) {
  const Job three = job(JobVerb::identify, 3);
  Estimate estimate;
  estimate.parameters.resize(1);
  estimate.parameters[0].name = "spine, upper \"half\"";
  estimate.parameters[0].unit = "Pa/m";
  estimate.parameters[0].estimate = {2e5, 1e5, 4e5, 0, 0};
  fs::create_directories(folder_ / "case_0");
  write_record(folder_ / "case_0/estimate.json", estimate);
  estimate.parameters[0].estimate.value = 3e5;
  fs::create_directories(folder_ / "case_2");
  write_record(folder_ / "case_2/estimate.json", estimate);
  fs::copy(folder_ / "case_2", folder_ / "case_1");
  const std::vector<CaseStatus> states{{"case_0", CaseState::done, ""},
                                       {"case_1", CaseState::running, ""},  // what is there is of a job before
                                       {"case_2", CaseState::done, ""}};
  const JobResults results = results_of(three, folder_, states);
  EXPECT_EQ(
      results.csv(),
      "case,state,\"spine, upper \"\"half\"\" [Pa/m]\",\"spine, upper \"\"half\"\", lower [Pa/m]\",\"spine, upper "
      "\"\"half\"\", upper [Pa/m]\"\ncase_0,done,200000,100000,400000\ncase_1,running,,,\n"
      "case_2,done,300000,100000,400000\n");
}

TEST_F(Jobs, HaveATableOfTheirResultsAlsoWhereOneCannotBeRead) {
  const Job four = job(JobVerb::simulate, 4);
  RunSummary run;
  run.steps = 5;
  std::vector<CaseStatus> states;
  for (const JobCase& one : four.cases) {
    fs::create_directories(folder_ / one.name);
    write_record(folder_ / one.name / "summary.json", run);
    states.push_back({one.name, CaseState::done, ""});
  }
  write("case_0/summary.json", "{\"steps\":");
  const fs::path place = folder_ / "case_1/summary.json", own = folder_ / "case_2/summary.json";
  fs::remove(place);
  fs::create_directory(place);
  fs::remove(own);
  fs::create_symlink(own, own);
  const JobResults results = results_of(four, folder_, states);
  ASSERT_EQ(results.columns[2], "not read");
  EXPECT_TRUE(results.cells[0][2].starts_with((folder_ / "case_0/summary.json").string() + ": ")) << results.csv();
  EXPECT_EQ(results.cells[1][2], place.string() + ": is not a file");
  EXPECT_EQ(results.cells[2][2], own.string() + ": no such file");
  EXPECT_EQ(results.columns[3], "steps");
  EXPECT_EQ(results.cells[3][2] + results.cells[3][3], "5");
}

}  // namespace
}  // namespace tether
