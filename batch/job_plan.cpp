#include "batch/job_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

#include "batch/job_script.hpp"
#include "common/base/error.hpp"

namespace tether {
namespace {

/// Direct runs of the longest of 70 diagnoses (docs/diagnosis-validation.md: 66.2; half of them need at most 12.9).
constexpr int longest_diagnosis = 66;
/// [s]: in a time that is hardly longer than what is left for the end no work is done.
constexpr int least_time = seconds_to_end + 120;
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

/// Of "30", "30:00", "2:30:00", "1-12", "1-12:30", "1-12:30:00", as sbatch reads it [s]; nothing if it is none of them.
std::optional<double> seconds_in(const std::string& time) {
  static const std::regex form(R"((?:(\d+)-)?(\d+)(?::(\d+))?(?::(\d+))?)");
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

}  // namespace

void check_resources(const JobResources& resources) {
  check_word("--memory", resources.memory);
  check_word("--account", resources.account);
  check_word("--partition", resources.partition);
  for (const std::string& more : resources.more) check_word("--sbatch", more);
  if (resources.time.empty()) return;
  const std::optional<double> seconds = seconds_in(resources.time);
  if (!seconds)
    throw input_error("--time: {}: must be a time as sbatch has it: 30 (minutes), 2:30:00, 1-12 (days-hours)",
                      resources.time);
  if (*seconds > 0 && *seconds < least_time)
    throw input_error("--time: {}: must be at least {} minutes: {} before its end the programs save their state",
                      resources.time, least_time / 60, seconds_to_end / 60);
}

ExpectedTime expected_time(JobVerb verb, const MeasuredSteps& measured, int processes, int parameters) {
  const double run = static_cast<double>(measured.of_case) * measured.seconds_per_step;
  const std::string steps = fmt::format("{} steps of {:.2g} s", measured.of_case, measured.seconds_per_step);
  if (!makes_many_runs(verb)) return {run, steps};
  const bool is_identified = verb == JobVerb::identify;
  const int runs = is_identified ? parameters + 1 : longest_diagnosis;
  return {run * rounds(runs, processes),
          fmt::format("{} {} runs of {}, {} at once", is_identified ? "as" : "at most some", runs, steps, processes)};
}

void fill_from(const MeasuredSteps& measured, const ExpectedTime& expected, JobResources& resources) {
  const double models = 1.25 * measured.memory_mb * resources.processes;
  if (resources.memory.empty())
    resources.memory = fmt::format("{:.0f}M", 100 * std::ceil((models / resources.nodes + beside_models) / 100));
  if (resources.time.empty()) resources.time = hours(2 * expected.seconds + 600);
}

std::string plan_text(const Job& job, const std::optional<ExpectedTime>& expected) {
  const JobResources& r = job.resources;
  std::string text = fmt::format("{} of {} case{}, each on {} node{} with {} task{}{}\n", word_of(job.verb),
                                 job.cases.size(), job.cases.size() == 1 ? "" : "s", r.nodes, r.nodes == 1 ? "" : "s",
                                 r.tasks_per_node, r.tasks_per_node == 1 ? "" : "s", r.nodes == 1 ? "" : " each");
  text += fmt::format("  processes  {} model{} at once, each a master with fluid and solid, which take turns: a core\n",
                      r.processes, r.processes == 1 ? "" : "s");
  if (job.measured)
    text += fmt::format("  measured   {} steps of {}: {:.2g} s a step, {:.0f} MB a model\n", job.measured->steps,
                        job.cases.front().name, job.measured->seconds_per_step, job.measured->memory_mb);
  text += fmt::format("  memory     {} a node\n", of(r.memory));
  if (expected)
    text += fmt::format("  time       {}; expected {} ({})\n", of(r.time), hours(expected->seconds), expected->from);
  else
    text += fmt::format("  time       {}\n", of(r.time));
  return text;
}

}  // namespace tether
