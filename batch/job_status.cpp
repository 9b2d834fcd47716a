#include "batch/job_status.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "batch/job_script.hpp"
#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/name.hpp"
#include "common/base/way_on.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// What a job's script has written into a file; nothing if it has not come to that.
std::optional<std::string> word_in(const fs::path& file) {
  constexpr std::uintmax_t longest = 4000;  // bytes
  if (std::error_code none; fs::status(file, none).type() == fs::file_type::not_found) return std::nullopt;
  std::ifstream text = input_stream(file, std::ios::in, longest);
  std::string word;
  if (!(text >> word)) return std::nullopt;
  return word;
}

/// The last line of a log, which may be long, that tells what happens. How to go on the job's script knows.
std::string last_line_of(const fs::path& file) {
  constexpr std::streamoff enough = 4000;  // bytes
  std::ifstream log = input_stream(file, std::ios::binary);
  log.seekg(0, std::ios::end);
  log.seekg(std::max<std::streamoff>(0, log.tellg() - enough));
  std::string last;
  for (std::string line; std::getline(log, line);)
    if (!line.empty() && !is_about_going_on(line)) last = line;
  return last;
}

/// The other cases are told also where a log cannot be read.
std::string last_said_in(const fs::path& file) {
  if (std::error_code none; fs::status(file, none).type() == fs::file_type::not_found) return "";
  try {
    return last_line_of(file);
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string joined(const std::string& first, const std::string& second) {
  return first + (first.empty() || second.empty() ? "" : ": ") + second;
}

/// Where it is no more than that the task waits, or runs.
std::string told_state(const slurm::Task& task) {
  return task.state == "PENDING" || task.state == "RUNNING" ? "" : task.state;
}

CaseStatus status_of(const JobCase& one, const fs::path& files, const slurm::Task* task, bool answers) {
  const std::string said = last_said_in(files / (one.name + ".log"));
  const auto is = [&](slurm::Stage stage) { return task != nullptr && stage_of(*task) == stage; };
  if (is(slurm::Stage::runs))
    return {one.name, CaseState::running,
            joined(told_state(*task), joined(fmt::format("{} on {}", task->time, task->nodes), said))};
  if (is(slurm::Stage::waits)) return {one.name, CaseState::waiting, joined(told_state(*task), task->reason)};
  try {
    if (const auto code = word_in(files / "ended" / one.name))
      return {one.name, *code == "0" ? CaseState::done : CaseState::failed, *code == "0" ? "" : said};
  } catch (const InputError& error) {  // the others are told
    return {one.name, CaseState::unknown, error.what()};
  }
  if (is(slurm::Stage::unknown)) return {one.name, CaseState::unknown, joined(task->state, said)};
  if (!answers) return {one.name, CaseState::unknown, said};
  return {one.name, CaseState::gone, joined(task == nullptr ? "" : task->state, said)};
}

void check_job_name(const std::string& file, const std::string& field, std::string word) {
  if (is_file_name(word)) return;
  std::replace(word.begin(), word.end(), '\n', '?');  // lest it look like a message of its own
  throw input_error("{}: {}: '{}': {}", file, field, word, file_name_rule);
}

void check_record(const Job& job, const std::string& file) {
  for (std::size_t k = 0; k < job.cases.size(); ++k)
    check_job_name(file, fmt::format("cases[{}].name", k), job.cases[k].name);
  if (!job.number.empty()) check_job_name(file, "number", job.number);
  if (job.cluster) check_job_name(file, "cluster", *job.cluster);
}

/// "4711", or "4711;other". Without a cluster it is of the one that is known with that number.
void take_number(Job& job, const std::string& given) {
  const std::size_t end = std::min(given.find(';'), given.size());
  const std::string number = given.substr(0, end), cluster = given.substr(std::min(end + 1, given.size()));
  if (number != job.number) job.cluster.reset();
  if (!cluster.empty()) job.cluster = cluster;
  job.number = number;
}

}  // namespace

Job read_job(const fs::path& folder) {
  const fs::path record = folder / job_files / "job.json";
  if (!fs::exists(record)) throw input_error("{}: holds no job of tether submit", folder.string());
  auto job = read_record<Job>(record);
  check_record(job, record.string());
  const fs::path number = folder / job_files / "number";  // by the script, whoever submitted it
  if (const auto given = word_in(number)) take_number(job, *given);
  check_record(job, number.string());
  return job;
}

bool is_perhaps_submitted(const Job& job, const fs::path& folder) {
  return job.number.empty() && fs::exists(folder / job_files / submission_begun);
}

std::string perhaps_submitted(const Job& job, const fs::path& folder) {
  const std::string clusters = asked_clusters(job.resources);
  return fmt::format("perhaps submitted: squeue {}--me --name={} tells", clusters.empty() ? "" : "-M " + clusters + " ",
                     job_name(job, folder));
}

std::string told_number(const Job& job) {
  return job.number + (job.cluster ? " of cluster " + *job.cluster : "");
}

std::string way_to_end(const Job& job) {
  return "scancel " + (job.cluster ? "-M " + *job.cluster + " " : "") + job.number;
}

std::vector<CaseStatus> status_of(const Job& job, const fs::path& folder,
                                  const std::optional<std::vector<slurm::Task>>& tasks) {
  std::vector<CaseStatus> all;
  for (std::size_t k = 0; k < job.cases.size(); ++k) {
    const JobCase& one = job.cases[k];
    const slurm::Task* task = nullptr;
    if (tasks)
      for (const slurm::Task& other : *tasks)
        if (other.index == static_cast<int>(k)) task = &other;
    if (is_perhaps_submitted(job, folder))
      all.push_back({one.name, CaseState::unknown, perhaps_submitted(job, folder)});
    else if (job.number.empty())
      all.push_back({one.name, CaseState::unsubmitted, ""});
    else
      all.push_back(status_of(one, folder / job_files, task, tasks.has_value()));
  }
  return all;
}

std::string text_of(const std::vector<CaseStatus>& cases) {
  std::string counts, lines;
  for (const auto& [state, word, meaning] : words_of<CaseState>) {
    const auto count = std::count_if(cases.begin(), cases.end(), [s = state](const auto& c) { return c.state == s; });
    if (count > 0) counts += fmt::format("{} {} {}", counts.empty() ? ":" : ",", count, word);
  }
  for (const CaseStatus& one : cases)
    lines += fmt::format("  {:<24} {:<10} {}\n", one.name, word_of(one.state), one.note);
  return fmt::format("{} case{}{}\n{}", cases.size(), cases.size() == 1 ? "" : "s", counts, printable(lines));
}

}  // namespace tether
