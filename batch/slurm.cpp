#include "batch/slurm.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"

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

}  // namespace

std::string submit(const std::filesystem::path& script) {
  // in a process group of its own, which Ctrl-C does not reach
  const std::optional<ChildEnd> end = asked({{"sbatch", "--parsable", script.string()}, {}}, capture_in_foreground);
  if (!end)
    throw input_error("there is no sbatch: is this a machine of a Slurm cluster? --dry-run only writes {}",
                      script.string());
  if (end->exit_code > 128) throw run_error("{}: sbatch {}", script.string(), how_it_ended(end->exit_code));
  if (end->exit_code != 0) throw input_error("{}: {}", script.string(), said(*end));
  const std::string number = end->output.substr(0, end->output.find_first_of(";\n"));
  if (number.empty()) throw run_error("{}: sbatch gave it no number: {}", script.string(), end->output);
  return number;
}

bool has_ended(const Task& task) {
  constexpr std::array states{"COMPLETED", "FAILED",    "CANCELLED",     "TIMEOUT",
                              "NODE_FAIL", "BOOT_FAIL", "OUT_OF_MEMORY", "DEADLINE"};
  return std::find(states.begin(), states.end(), task.state) != states.end();
}

std::optional<std::vector<Task>> tasks_of(const std::string& job) {
  const std::optional<ChildEnd> end =
      asked({{"squeue", "--noheader", "--array", "--jobs=" + job, "--states=all", "--format=%K|%T|%r|%M|%N"}, {}});
  if (!end) return std::nullopt;
  // One that ended long ago is an error to squeue.
  if (end->exit_code != 0 && end->errors.find("Invalid job id") == std::string::npos) return std::nullopt;
  std::vector<Task> tasks;
  std::istringstream lines(end->output);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) tasks.push_back(read_task(line));
  return tasks;
}

}  // namespace tether::slurm
