#include "batch/job_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <regex>

#include "batch/job_script.hpp"
#include "common/base/error.hpp"
#include "common/base/progress_line.hpp"

namespace tether {
namespace {

/// Direct runs of the 57 diagnoses that made any, beside those of each number (docs/diagnosis-validation.md): half need
/// at most 23.6, the longest 90.3.
constexpr int half_of_diagnoses = 24, longest_diagnosis = 91;
/// An explanation has beside its diagnosis: the model as it is, an identification of one parameter, what that gave.
constexpr int beside_diagnosis = 4;
/// [s]: in a time that is hardly longer than what is left for the end no work is done.
constexpr int least_time = seconds_to_end + 120;
constexpr int longest_time = 366 * 86400;
/// [MB]: what tether, the master above the models, and the drawing of a picture take beside them.
constexpr double beside_models = 400;

int rounds(int runs, int at_once) {
  return (runs + at_once - 1) / at_once;
}

std::string hours(double seconds) {
  const auto minutes = static_cast<int>(std::ceil(seconds / 60));
  return fmt::format("{}:{:02}:00", minutes / 60, minutes % 60);
}

std::string of(const std::string& given) {
  return given.empty() ? "the cluster's default" : given;
}

/// [s] of a whole run.
double seconds_of(const MeasuredSteps& measured) {
  return static_cast<double>(measured.of_case) * measured.seconds_per_step;
}

std::string steps_text(const MeasuredSteps& measured) {
  return fmt::format("{} steps of {:.2g} s", measured.of_case, measured.seconds_per_step);
}

/// "207 steps of 0.02 s, 92 MB a model; of the coarser model 104 steps of 0.009 s"
std::string steps_text(const PlannedRuns& planned) {
  std::string text = fmt::format("{}, {:.0f} MB a model", steps_text(planned.model), planned.model.memory_mb);
  if (planned.coarser) text += "; of the coarser model " + steps_text(*planned.coarser);
  for (const MeasuredSteps& finer : planned.finer)
    text += fmt::format("; of a finer one {}, {:.0f} MB", steps_text(finer), finer.memory_mb);
  return text;
}

std::string runs_text(JobVerb verb, const PlannedRuns& planned) {
  if (verb == JobVerb::identify) return fmt::format("{} particles, which go through the beat together", planned.most);
  if (planned.first_order == 0) return planned.most == 1 ? "1" : std::to_string(planned.most);
  return fmt::format(
      "{} of the {}model: as it is, and one for each number that may be wrong; then what takes as long as "
      "{} (half of 57 diagnoses) to {} (the longest) of the model",
      planned.first_order, planned.coarser ? "coarser " : "", planned.least, planned.most);
}

/// "3 min 20 s to 9 min 10 s"
std::string time_text(const PlannedRuns& planned) {
  const ExpectedTime expected = expected_time(planned);
  const std::string least = duration_text(expected.least), most = duration_text(expected.most);
  return least == most ? least : least + " to " + most;
}

/// cores_of_model: 0: not known.
std::string processes_line(int processes, int cores_of_model) {
  const std::string models =
      fmt::format("  processes  {} model{} at once, each ", processes, processes == 1 ? "" : "s");
  if (cores_of_model == 0) return models + "a master with fluid and solid\n";
  if (cores_of_model == 1) return models + "a master with fluid and solid, which take turns: a core\n";
  return models + fmt::format("in the processes of coupling.ranks, of which fluid's and solid's take turns: {} cores\n",
                              cores_of_model);
}

/// Of "30", "30:00", "2:30:00", "1-12", "1-12:30", "1-12:30:00", as sbatch reads it [s]; nothing if it is none of them.
std::optional<double> seconds_in(const std::string& time) {
  static const std::regex form(R"((?:(\d{1,9})-)?(\d{1,9})(?::([0-5]?\d))?(?::([0-5]?\d))?)");
  std::smatch part;
  if (!std::regex_match(time, part, form)) return std::nullopt;
  const auto number = [&](int k) { return part[k].matched ? std::stod(part[k].str()) : 0; };
  if (part[1].matched) return 86400 * number(1) + 3600 * number(2) + 60 * number(3) + number(4);
  if (part[4].matched) return 3600 * number(2) + 60 * number(3) + number(4);
  return 60 * number(2) + number(3);
}

/// A word of sbatch's options, without what a script or sbatch would take for something else.
void check_word(const char* option, const std::string& text) {
  static const std::regex word(R"([A-Za-z0-9][A-Za-z0-9_.,:=+/@*\[\]-]*)");
  if (!text.empty() && !std::regex_match(text, word))
    throw input_error("{}: '{}': must be a word of letters, digits and _.,:=+/@*[]-, not - at its begin", option, text);
}

void check_memory(const std::string& memory) {
  constexpr double least_mb = 30;  // the smallest model takes 37 MB (docs/performance.md)
  static const std::regex form("([0-9]{1,9})([KMGTkmgt]?)");
  std::smatch part;
  if (memory.empty()) return;
  if (!std::regex_match(memory, part, form))
    throw input_error("--memory: {}: must be a whole number with K, M, G or T: 8G", memory);
  const char unit = part[2].length() == 0 ? 'M' : static_cast<char>(std::toupper(part[2].str().front()));
  const double mb = std::stod(part[1].str()) * (unit == 'K' ? 1.0 / 1024 : unit == 'M' ? 1 : 1024);
  if (mb > 0 && mb < least_mb)
    throw input_error("--memory: {}: is {:.2g} MB for Slurm, in which no model runs: 8G is eight gigabytes", memory,
                      mb);
}

}  // namespace

void check_resources(const JobResources& resources) {
  check_word("--memory", resources.memory);
  check_word("--account", resources.account);
  check_word("--partition", resources.partition);
  for (const std::string& more : resources.more) check_word("--sbatch", more);
  check_memory(resources.memory);
  if (resources.time.empty()) return;
  const std::optional<double> seconds = seconds_in(resources.time);
  if (!seconds || *seconds > longest_time)
    throw input_error(
        "--time: {}: must be a time as sbatch has it: 30 (minutes), 2:30:00, 1-12 (days-hours); at most a year",
        resources.time);
  if (*seconds > 0 && *seconds < least_time)
    throw input_error("--time: {}: must be at least {} minutes: {} before its end the programs save their state",
                      resources.time, least_time / 60, seconds_to_end / 60);
}

PlannedRuns planned_runs(JobVerb verb, int parameters) {
  PlannedRuns planned;
  if (verb == JobVerb::identify) planned.least = planned.most = parameters + 1;
  if (verb != JobVerb::diagnose && verb != JobVerb::explain) return planned;
  const int beside = verb == JobVerb::explain ? beside_diagnosis : 0;
  planned.least = half_of_diagnoses + beside;
  planned.most = longest_diagnosis + beside;
  return planned;
}

ExpectedTime expected_time(const PlannedRuns& planned) {
  const int room = std::max(1, planned.cores / planned.cores_of_model);
  const int at_once = planned.cores > 0 ? std::min(room, planned.processes) : planned.processes;
  const double run = seconds_of(planned.model);
  double first_order = rounds(planned.first_order, at_once) * seconds_of(planned.coarser.value_or(planned.model));
  for (const MeasuredSteps& finer : planned.finer) first_order += seconds_of(finer);
  return {first_order + rounds(planned.least, at_once) * run, first_order + rounds(planned.most, at_once) * run};
}

int models_a_node(int models, int nodes) {
  return (models + nodes - 1) / nodes;
}

double expected_memory(const PlannedRuns& planned, int nodes) {
  double of_one = planned.model.memory_mb;
  for (const MeasuredSteps& finer : planned.finer) of_one = std::max(of_one, finer.memory_mb);
  return 1.25 * of_one * models_a_node(planned.processes, nodes) + beside_models;
}

void fill_from(const PlannedRuns& planned, JobResources& resources) {
  if (resources.memory.empty())
    resources.memory = fmt::format("{:.0f}M", 100 * std::ceil(expected_memory(planned, resources.nodes) / 100));
  if (resources.time.empty()) resources.time = hours(2 * expected_time(planned).most + 600);
}

std::string plan_text(const Job& job, const std::optional<PlannedRuns>& planned) {
  const JobResources& r = job.resources;
  std::string text = fmt::format("{} of {} case{}, each on {} node{} with {} task{}{}\n", word_of(job.verb),
                                 job.cases.size(), job.cases.size() == 1 ? "" : "s", r.nodes, r.nodes == 1 ? "" : "s",
                                 r.tasks_per_node, r.tasks_per_node == 1 ? "" : "s", r.nodes == 1 ? "" : " each");
  text += processes_line(r.processes, planned ? planned->cores_of_model : 0);
  if (planned) text += "  measured   on " + job.cases.front().name + " here: " + steps_text(*planned) + "\n";
  text += fmt::format("  memory     {} a node\n", of(r.memory));
  text += fmt::format("  time       {}", of(r.time));
  return text +
         (planned ? fmt::format("; expected {} ({})\n", time_text(*planned), runs_text(job.verb, *planned)) : "\n");
}

std::string plan_text(JobVerb verb, const PlannedRuns& planned) {
  return fmt::format("tether {} would take, if nothing of it is there yet:\n", word_of(verb)) +
         fmt::format("  runs       {}\n", runs_text(verb, planned)) +
         processes_line(planned.processes, planned.cores_of_model) +
         fmt::format("  measured   here: {}\n", steps_text(planned)) +
         fmt::format("  memory     {:.0f} MB\n", expected_memory(planned, 1)) +
         fmt::format("  time       {}{}\n", time_text(planned),
                     planned.first_order > 0 ? " for the runs; statistics and pictures beside" : "");
}

}  // namespace tether
