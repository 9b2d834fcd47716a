#include "batch/job_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "batch/job_script.hpp"
#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/name.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

bool runs(const slurm::Task& task) {
  return task.state == "RUNNING" || task.state == "COMPLETING";
}

/// Whether a line only tells how to go on, which the job's script knows.
bool is_about_going_on(const std::string& line) {
  constexpr std::array beginnings{"To continue: ", "The state after ", "No state is saved"};
  return std::any_of(beginnings.begin(), beginnings.end(), [&](const char* text) { return line.starts_with(text); });
}

/// What a job's script has written into a file; nothing if it has not come to that.
std::optional<std::string> word_in(const fs::path& file) {
  constexpr std::uintmax_t longest = 4000;  // bytes
  if (std::error_code none; fs::status(file, none).type() == fs::file_type::not_found) return std::nullopt;
  std::ifstream text = input_stream(file, std::ios::in, longest);
  std::string word;
  if (!(text >> word)) return std::nullopt;
  return word;
}

/// The last line of a log, which may be long, that tells what happens.
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

CaseStatus status_of(const JobCase& one, const fs::path& files, const slurm::Task* task, bool answers) {
  const std::string said = last_said_in(files / (one.name + ".log"));
  if (task != nullptr && runs(*task))
    return {one.name, CaseState::running, joined(fmt::format("{} on {}", task->time, task->nodes), said)};
  if (task != nullptr && !has_ended(*task)) return {one.name, CaseState::waiting, task->reason};
  try {
    if (const auto code = word_in(files / "ended" / one.name))
      return {one.name, *code == "0" ? CaseState::done : CaseState::failed, *code == "0" ? "" : said};
  } catch (const InputError& error) {  // the others are told
    return {one.name, CaseState::unknown, error.what()};
  }
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
}

}  // namespace

Job read_job(const fs::path& folder) {
  const fs::path record = folder / job_files / "job.json";
  if (!fs::exists(record)) throw input_error("{}: holds no job of tether submit", folder.string());
  auto job = read_record<Job>(record);
  check_record(job, record.string());
  const fs::path number = folder / job_files / "number";  // by the script, whoever submitted it
  if (auto given = word_in(number)) job.number = std::move(*given);
  check_record(job, number.string());
  return job;
}

bool is_perhaps_submitted(const Job& job, const fs::path& folder) {
  return job.number.empty() && fs::exists(folder / job_files / submission_begun);
}

std::string perhaps_submitted(const Job& job, const fs::path& folder) {
  return fmt::format("perhaps submitted: squeue --me --name={} tells", job_name(job, folder));
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
