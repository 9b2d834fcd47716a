#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/record.hpp"

/// What was given to a scheduler: job/job.json of a job's folder.
namespace tether {

/// In the job's folder, beside the cases' results: script, record, logs.
inline constexpr const char* job_files = "job";
inline constexpr const char* results_table = "results.csv";

/// What a job does with each of its cases.
enum class JobVerb { simulate, compare, identify, diagnose, explain };

template <>
inline constexpr auto words_of<JobVerb> = std::to_array<WordOf<JobVerb>>({
    {JobVerb::simulate, "simulate", "a run"},
    {JobVerb::compare, "compare", "a run, set against the measurements"},
    {JobVerb::identify, "identify", "parameters from the measurements"},
    {JobVerb::diagnose, "diagnose", "which effect is missing"},
    {JobVerb::explain, "explain", "the whole path from a model to its explanation"},
});

/// Whether it needs --resume to go on; the others find by themselves what was made.
constexpr bool is_resumed(JobVerb verb) {
  return verb == JobVerb::simulate || verb == JobVerb::compare || verb == JobVerb::identify;
}
/// Whether it makes several runs of the model at once.
constexpr bool makes_many_runs(JobVerb verb) {
  return verb != JobVerb::simulate && verb != JobVerb::compare;
}

struct JobCase {
  static constexpr const char* type_name = "job_case";
  std::string name, case_file;
  std::string row = {};  ///< file and line of the table that it is made of; empty: of none. Not kept

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of its folder of results, in the job's folder");
    field("case", self.case_file, "path");
  }
};

/// What a few steps on this machine took.
struct MeasuredSteps {
  static constexpr const char* type_name = "measured_steps";
  std::int64_t steps = 0, of_case = 0;
  double seconds_per_step = 0, memory_mb = 0;

  static void fields(auto& self, auto&& field) {
    field("steps", self.steps, "that were made");
    field("of_case", self.of_case, "steps of the whole run");
    field("seconds_per_step", self.seconds_per_step, "wall clock, of one model [s]");
    field("memory_mb", self.memory_mb, "of one model, all its processes at their peak [MB]");
  }
};

/// What each case of a job asks of the scheduler.
struct JobResources {
  static constexpr const char* type_name = "job_resources";
  int nodes = 1, processes = 1, tasks_per_node = 1;
  std::string memory, time, account, partition;
  std::vector<std::string> more;

  static void fields(auto& self, auto&& field) {
    field("nodes", self.nodes, "machines");
    field("processes", self.processes, "models that run at once");
    field("tasks_per_node", self.tasks_per_node,
          "processors of each: those that a model keeps busy, since fluid and wall take turns");
    field("memory", self.memory, "of each node, as Slurm writes it; empty: the cluster's default");
    field("time", self.time, "limit, as Slurm writes it; empty: the cluster's default");
    field("account", self.account, "empty: the user's default");
    field("partition", self.partition, "empty: the cluster's default");
    field("more", self.more, "further options of sbatch");
  }
};

struct Job {
  static constexpr const char* type_name = "job";
  JobVerb verb = JobVerb::simulate;
  std::string number;
  std::string program;
  std::vector<JobCase> cases;
  std::optional<MeasuredSteps> measured;
  JobResources resources;
  std::optional<std::string> cluster = std::nullopt;

  static void fields(auto& self, auto&& field) {
    field("verb", self.verb, "what is done with each case");
    field("number", self.number, "the scheduler's; empty: not submitted");
    field("cluster", self.cluster, "whose number it is; null: that of the machine where it was submitted");
    field("program", self.program, "path of tether");
    field("cases", self.cases, "in the order of the tasks of a job array");
    field("measured", self.measured, "of the first case; null: nothing was measured");
    field("resources", self.resources, "of each case");
  }
};

}  // namespace tether
