#include "tether/submit.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>

#include "batch/job_cases.hpp"
#include "batch/job_folder.hpp"
#include "batch/job_plan.hpp"
#include "batch/job_results.hpp"
#include "batch/job_script.hpp"
#include "batch/job_status.hpp"
#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/base/process.hpp"
#include "common/base/temporary_folder.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/config/cores_of_model.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/programs.hpp"
#include "tether/plan.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* script_name = "script.sh";

struct Typed {
  std::string verb;
  fs::path given, table, output;
  JobResources resources;
  int processes = 0, tasks_per_node = 0;
  bool dry_run = false, overwrite = false;
};

/// Parses, acts, and turns what is thrown into messages and exit codes.
int run_app(CLI::App& app, int argc, char** argv, const std::function<int()>& act) {
  prepare_process();
  std::vector<std::string> words(argv, argv + argc);
  std::reverse(words.begin(), words.end());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_input_wrong;
  }
  return guarded(app.get_name(), act);
}

std::vector<std::string> words_of_verbs() {
  std::vector<std::string> words;
  for (const auto& entry : words_of<JobVerb>) words.emplace_back(entry.word);
  return words;
}

void add_options(CLI::App& app, Typed& typed) {
  JobResources& r = typed.resources;
  app.add_option("verb", typed.verb, "what to do with each case")
      ->required()
      ->type_name("VERB")
      ->check(CLI::IsMember(words_of_verbs()));
  app.add_option("case", typed.given, "a case file, or a folder: each NAME.yaml and NAME/case.yaml in it")
      ->required()
      ->type_name("CASE.yaml|FOLDER");
  app.add_option("--table", typed.table,
                 "of cases that build on CASE.yaml: a column `name`, and one for each field that differs")
      ->type_name("TABLE.csv");
  app.add_option("--output", typed.output, "folder for the results of all cases (default out/NAME_job)")
      ->type_name("DIR");
  app.add_option("--processes", typed.processes, "models of a case that run at once")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  app.add_option("--nodes", r.nodes, "of each case (default 1)")->type_name("N")->check(CLI::Range(1, 100000));
  app.add_option("--tasks-per-node", typed.tasks_per_node, "processors of each (default: one for each model)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  app.add_option("--memory", r.memory, "of each node, as Slurm writes it: 8G (default: measured by a few steps)");
  app.add_option("--time", r.time, "limit, as Slurm writes it: 12:00:00 (default: measured by a few steps)");
  app.add_option("--account", r.account, "to be charged");
  app.add_option("--partition", r.partition, "of the cluster");
  app.add_option("--sbatch", r.more, "a further option of sbatch, such as qos=high; may be repeated")
      ->type_name("OPTION");
  app.add_flag("--dry-run", typed.dry_run, "write the script, show it and the plan, submit nothing");
  app.add_flag("--overwrite", typed.overwrite,
               "replace an ended job that is in the folder; runs start anew, diagnoses keep their runs");
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  if (!(out << text).flush()) throw write_error(file);
}

/// Absolute, as the system finds it: a `..` behind a link leads out of what the link leads to. Without what does not
/// name anything at its end.
fs::path whole(const fs::path& path) {
  const fs::path named = fs::absolute(path);
  const bool leads_up = std::find(named.begin(), named.end(), "..") != named.end();
  const fs::path found = leads_up ? fs::weakly_canonical(named) : named.lexically_normal();
  return found.has_filename() ? found : found.parent_path();
}

fs::path job_folder(const Typed& typed) {
  if (!typed.output.empty()) return whole(typed.output);
  const fs::path given = whole(typed.given);
  const bool is_named_by_folder = given.filename() == "case.yaml" || fs::is_directory(given);
  const fs::path named = given.filename() == "case.yaml" ? given.parent_path() : given;
  return fs::absolute(fs::path("out") / ((is_named_by_folder ? named.filename() : named.stem()).string() + "_job"));
}

/// What would be reserved and never used.
void check_processes(const Typed& typed) {
  if (typed.processes > 0 && !makes_many_runs(*from_word<JobVerb>(typed.verb)))
    throw input_error("--processes: tether {} makes one run: leave it out", typed.verb);
}

/// A number in each task's name that no case of the job has.
void check_array(const Typed& typed, std::size_t cases) {
  const auto& more = typed.resources.more;
  const auto array = std::find_if(more.begin(), more.end(), [](const std::string& option) {
    return option == "array" || option.starts_with("array=");
  });
  if (array != more.end() && cases == 1) throw input_error("--sbatch: {}: the job has one case", *array);
}

/// What is wrong is told before it waits for its turn, of all cases at once.
void check_cases(const std::vector<JobCase>& cases, JobVerb verb) {
  constexpr auto tell_every =
      std::chrono::seconds(10);  // each case is read by its programs: a tenth of a second or two
  auto told = std::chrono::steady_clock::now();
  std::string wrong;
  std::size_t checked = 0;
  for (const JobCase& one : cases) {
    try {
      check_case_for(verb, one.case_file);
    } catch (const InputError& error) {
      wrong += (wrong.empty() ? "" : "\n") + told_by_row(one, error.what());
    }
    ++checked;
    if (const auto now = std::chrono::steady_clock::now(); now - told > tell_every) {
      std::cerr << fmt::format("{} of {} cases are read\n", checked, cases.size());
      told = now;
    }
  }
  if (!wrong.empty()) throw InputError(wrong);
}

/// Those of a table are written into `made`.
std::vector<JobCase> cases_of(const Typed& typed, const fs::path& made) {
  return typed.table.empty() ? job_cases(typed.given) : job_cases_of_table(typed.given, typed.table, made);
}

void check_keeps_read(const Typed& typed, const fs::path& folder, const std::vector<JobCase>& cases) {
  std::set<fs::path> read{typed.given};
  if (!typed.table.empty()) read.insert(typed.table);
  check_keeps_read(folder, cases, read);
}

/// Of the case that needs most.
int cores_of_model(const std::vector<JobCase>& cases) {
  int most = 1;
  for (const JobCase& one : cases) most = std::max(most, cores_of_model(CaseFile(one.case_file)));
  return most;
}

/// What the job asks for where the user did not say. The runs that were measured for it, if any were.
std::optional<PlannedRuns> plan(const Typed& typed, Job& job) {
  JobResources& r = job.resources;
  const JobCase& first = job.cases.front();
  r.processes = typed.processes > 0 ? typed.processes : models_at_once(job.verb, first.case_file);
  if (r.nodes > r.processes)
    throw input_error("--nodes: {}: a model stays on one node, and no more than {} {} at work at once", r.nodes,
                      r.processes, r.processes == 1 ? "is" : "are");
  const int cores = cores_of_model(job.cases);
  r.tasks_per_node = typed.tasks_per_node > 0 ? typed.tasks_per_node : models_a_node(r.processes, r.nodes) * cores;
  if (!r.memory.empty() && !r.time.empty()) return std::nullopt;
  try {
    PlannedRuns planned = planned_of(job.verb, first.case_file, r.processes);
    planned.cores_of_model = cores;
    job.measured = planned.model;
    fill_from(planned, r);
    return planned;
  } catch (const RunError& error) {
    if (first.row.empty()) throw;
    throw run_error("{}: {}", first.row, error.what());
  }
}

/// Writes the job's script and, unless that is all that is wanted, gives it to sbatch. An interruption waits until it
/// is known whether the job is submitted, and tells its number.
void place_job(const Typed& typed, const fs::path& folder, Job& job, const std::string& text) {
  static std::string way_on;  // lives as long as the program
  way_on = fmt::format("tether status {} says whether the job is submitted", folder.string());
  std::optional<WhenInterrupted> told(way_on.c_str());
  const InterruptionsWait until_recorded;
  NewJob made(folder, job);
  cases_of(typed, folder / job_files / "cases");
  const fs::path script = folder / job_files / script_name;
  write_text(script, text);
  if (typed.dry_run) return made.keep();
  const slurm::Submitted submitted = made.submit(script);
  job.number = submitted.number;
  job.cluster = submitted.cluster;
  told.reset();
  way_on = fmt::format("job {} is submitted: {} ends it", told_number(job), way_to_end(job));
  told.emplace(way_on.c_str());
  made.record(job);
  if (!submitted.doubt.empty())
    throw run_error("{}; job {} was perhaps submitted: tether status {} tells, {} ends it", submitted.doubt,
                    told_number(job), folder.string(), way_to_end(job));
}

/// All that can be refused is refused before anything in the folder is touched: a job that is there stays as it is.
int act(const Typed& typed) {
  const fs::path folder = job_folder(typed), files = folder / job_files;
  check_resources(typed.resources);
  check_processes(typed);
  check_replaced(folder, typed.overwrite);
  const ScratchFolder tried("tether_cases");
  Job job{*from_word<JobVerb>(typed.verb),         "", sibling("tether").string(),
          cases_of(typed, tried.path() / "cases"), {}, typed.resources};
  check_array(typed, job.cases.size());
  check_cases(job.cases, job.verb);
  check_keeps_read(typed, folder, job.cases);
  const std::optional<PlannedRuns> planned = plan(typed, job);
  if (!typed.table.empty())
    for (JobCase& one : job.cases) one.case_file = files / "cases" / fs::path(one.case_file).filename();
  const std::string text = job_script(job, folder);
  hold_output(folder);
  put_back_job(folder);                     // of a submission that was killed
  check_replaced(folder, typed.overwrite);  // another may have been there until now
  place_job(typed, folder, job, text);
  std::cout << plan_text(job, planned);
  if (typed.dry_run)
    std::cout << fmt::format("In {}, not submitted:\n\n{}", (files / script_name).string(), text);
  else
    std::cout << fmt::format("Job {}, results in {}: tether status {}\n", told_number(job), folder.string(),
                             folder.string());
  return exit_done;
}

/// Of the verbs that look at a job.
int with_job(const char* name, const char* purpose, int argc, char** argv,
             const std::function<void(const Job&, const fs::path&, const std::vector<CaseStatus>&)>& show) {
  fs::path given;
  CLI::App app(purpose, std::string("tether ") + name);
  app.add_option("folder", given, "the job's folder, as tether submit told it")->required()->type_name("FOLDER");
  return run_app(app, argc, argv, [&] {
    const fs::path folder = whole(given);
    const Job job = read_job(folder);
    const auto tasks = job.number.empty() ? std::nullopt : slurm::tasks_of(job.number, job.cluster);
    if (!job.number.empty() && !tasks)
      std::cerr << "Slurm does not answer: what follows is by the job's folder alone\n";
    show(job, folder, status_of(job, folder, tasks));
    return exit_done;
  });
}

std::string number_or_why_none(const Job& job, const fs::path& folder) {
  if (!job.number.empty()) return told_number(job);
  return is_perhaps_submitted(job, folder) ? "perhaps submitted" : "not submitted";
}

void show_status(const Job& job, const fs::path& folder, const std::vector<CaseStatus>& states) {
  std::cout << fmt::format("job {}, {}, ", number_or_why_none(job, folder), word_of(job.verb)) << text_of(states);
}

void show_results(const Job& job, const fs::path& folder, const std::vector<CaseStatus>& states) {
  const JobResults results = results_of(job, folder, states);
  write_whole(folder / results_table, results.csv());
  std::cout << results.text() << "In " << (folder / results_table).string() << "\n";
}

}  // namespace

int submit(int argc, char** argv) {
  Typed typed;
  CLI::App app("give a case, a folder of cases or a table of them to Slurm", "tether submit");
  add_options(app, typed);
  return run_app(app, argc, argv, [&] { return act(typed); });
}

int job_status(int argc, char** argv) {
  return with_job("status", "what became of the cases of a job", argc, argv, show_status);
}

int job_results(int argc, char** argv) {
  return with_job("results", "one table of what the cases of a job found", argc, argv, show_results);
}

}  // namespace tether
