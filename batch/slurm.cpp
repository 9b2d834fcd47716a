#include "batch/slurm.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/base/shortened.hpp"

namespace tether::slurm {
namespace {

/// Nothing if there is no such program.
std::optional<ChildEnd> asked(const Command& command, ChildEnd (*run)(const Command&) = capture) {
  try {
    return run(command);
  } catch (const RunError&) {
    return std::nullopt;
  }
}

std::string said(const ChildEnd& end) {
  return end.errors.empty() ? how_it_ended(end.exit_code) : end.errors.substr(0, end.errors.find_last_not_of('\n') + 1);
}

int number_of(const std::string& text) {
  int number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// "12|3|PENDING|Resources|0:00|n0": job, task, state, reason, time, nodes. A reason is in parentheses where there is
/// none to run on.
Task read_task(const std::string& line) {
  std::array<std::string, 5> cells;
  std::istringstream text(line);
  for (std::string& cell : cells) std::getline(text, cell, '|');
  Task task{number_of(cells[0]), cells[1], cells[2], cells[3], cells[4]};
  if (task.reason == "None") task.reason.clear();
  return task;
}

/// "4711", or "4711;other" of another cluster, in all lines of what sbatch wrote: what is wrapped around it may write
/// more.
std::vector<Submitted> numbers_in(const std::string& output) {
  static const std::regex form(R"(\s*([0-9]{1,20})(?:;(\S*))?\s*)");
  std::vector<Submitted> numbers;
  std::istringstream lines(output);
  std::smatch part;
  for (std::string line; std::getline(lines, line);) {
    if (line.size() > 300 || !std::regex_match(line, part, form)) continue;
    const std::string cluster = part[2].str();
    if (cluster.empty())
      numbers.push_back({part[1].str(), std::nullopt});
    else if (is_file_name(cluster))
      numbers.push_back({part[1].str(), cluster});
  }
  return numbers;
}

/// In one line; empty: nothing.
std::string all_said(const ChildEnd& end) {
  std::istringstream words(end.errors + "\n" + end.output);
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  return shortened(printable(text), 300);
}

/// Whether a line tells that the scheduler was lost after it may have got the job (slurm_errno.c). Without a connection
/// nothing was sent.
bool is_of_a_lost_scheduler(const std::string& line) {
  constexpr std::array words{"Unable to contact slurm controller",
                             "Socket timed out",
                             "Zero Bytes were transmitted or received",
                             "Message send failure",
                             "Message receive failure",
                             "Communication shutdown failure",
                             "Failed to send entire message",
                             "Header lengths are longer than data received",
                             "Received zero length message",
                             "Insane message length",
                             "Unexpected message received",
                             "Protocol authentication error",
                             "Connection timed out",
                             "Connection reset",
                             "Connection forced closed",
                             "Broken pipe",
                             "delayed socket error"};
  const auto says = [&](const char* text) { return line.find(text) != std::string::npos; };
  return !says("(connect failure)") && std::any_of(words.begin(), words.end(), says);
}

/// Whether nothing was submitted, for certain. Slurm does not refuse without a word.
bool is_refused(const ChildEnd& end) {
  const bool is_failure = end.exit_code > 0 && end.exit_code <= 128;
  if (!is_failure || all_said(end).empty() || !numbers_in(end.output).empty()) return false;
  std::istringstream lines(end.errors + "\n" + end.output);
  for (std::string line; std::getline(lines, line);)
    if (is_of_a_lost_scheduler(line)) return false;
  return true;
}

}  // namespace

Submitted submit(const std::filesystem::path& script) {
  // in a process group of its own, which Ctrl-C does not reach
  const std::optional<ChildEnd> end = asked({{"sbatch", "--parsable", script.string()}, {}}, capture_in_foreground);
  if (!end)
    throw input_error("there is no sbatch: is this a machine of a Slurm cluster? --dry-run only writes {}",
                      script.string());
  if (is_refused(*end)) throw input_error("{}: {}", script.string(), said(*end));
  const std::string failed =
      fmt::format("{}: sbatch {} and said '{}'", script.string(), how_it_ended(end->exit_code), all_said(*end));
  std::vector<Submitted> numbers = numbers_in(end->output);
  if (numbers.size() != 1)
    throw run_error("{}, {}", failed, numbers.empty() ? "no number of a job" : "several numbers");
  if (end->exit_code != 0) numbers.front().doubt = failed;
  return numbers.front();
}

Stage stage_of(const Task& task) {
  using enum Stage;
  // "JOB STATE CODES" of squeue's manual. A suspended job keeps its nodes.
  static constexpr std::array<std::pair<std::string_view, Stage>, 24> states{
      {{"PENDING", waits},       {"CONFIGURING", waits},   {"REQUEUED", waits},     {"REQUEUE_FED", waits},
       {"REQUEUE_HOLD", waits},  {"RESV_DEL_HOLD", waits}, {"SPECIAL_EXIT", waits}, {"RUNNING", runs},
       {"COMPLETING", runs},     {"RESIZING", runs},       {"SIGNALING", runs},     {"STAGE_OUT", runs},
       {"STOPPED", runs},        {"SUSPENDED", runs},      {"BOOT_FAIL", ended},    {"CANCELLED", ended},
       {"COMPLETED", ended},     {"DEADLINE", ended},      {"FAILED", ended},       {"NODE_FAIL", ended},
       {"OUT_OF_MEMORY", ended}, {"PREEMPTED", ended},     {"REVOKED", ended},      {"TIMEOUT", ended}}};
  for (const auto& [state, stage] : states)
    if (task.state == state) return stage;
  return unknown;
}

bool has_ended(const Task& task) {
  return stage_of(task) == Stage::ended;
}

std::optional<std::vector<Task>> tasks_of(const std::string& job, const std::optional<std::string>& cluster) {
  // --federation: a task that is REVOKED here may run on another of its clusters
  const std::optional<ChildEnd> end =
      asked({{"squeue", cluster ? "--clusters=" + *cluster : "--federation", "--noheader", "--array", "--jobs=" + job,
              "--states=all", "--format=%K|%T|%r|%M|%N"},
             {}});
  if (!end) return std::nullopt;
  // One that ended long ago is an error to squeue.
  if (end->exit_code != 0 && end->errors.find("Invalid job id") == std::string::npos) return std::nullopt;
  std::vector<Task> tasks;
  std::istringstream lines(end->output);
  for (std::string line; std::getline(lines, line);)
    if (line.find('|') != std::string::npos) tasks.push_back(read_task(line));  // others: "CLUSTER: other"
  return tasks;
}

}  // namespace tether::slurm
