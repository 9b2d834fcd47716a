#include "batch/job_folder.hpp"

#include <algorithm>
#include <optional>

#include "batch/job_status.hpp"
#include "batch/slurm.hpp"
#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "job.json";
constexpr const char* way_out = "choose another folder with --output";

/// A folder without a job. Nothing is lost with one that is empty.
void check_is_nobodys(const fs::path& folder) {
  const fs::path files = folder / job_files, table = folder / results_table;
  std::error_code none;
  const bool is_free = !fs::exists(fs::symlink_status(files)) || (fs::is_directory(files) && fs::is_empty(files, none));
  for (const fs::path& place : {is_free ? fs::path() : files, table})
    if (!place.empty() && fs::exists(fs::symlink_status(place)))
      throw input_error("{}: tether submit did not make it, and would replace it; {}", place.string(), way_out);
}

/// Nothing if its record is damaged, and that may be replaced.
std::optional<Job> job_to_replace(const fs::path& folder, bool overwrite) {
  const fs::path files = folder / job_files;
  try {
    return read_job(folder);
  } catch (const InputError& error) {
    const bool looks_like_one = fs::exists(files / "script.sh") && fs::is_directory(files / "ended");
    if (!looks_like_one)
      throw input_error("{}\n{}: is not what tether submit made; {}", error.what(), files.string(), way_out);
    if (!overwrite)
      throw input_error("{}\n{}: {}; if its job has ended, --overwrite replaces it", error.what(), files.string(),
                        way_out);
    return std::nullopt;
  }
}

}  // namespace

void check_replaced(const fs::path& folder, bool overwrite) {
  if (!fs::exists(folder / job_files / record_name)) return check_is_nobodys(folder);
  const std::optional<Job> job = job_to_replace(folder, overwrite);
  if (!job || job->number.empty()) return;
  if (!overwrite)
    throw input_error(
        "{0}: holds a job; tether status {0} tells of it, --output makes another, --overwrite replaces it",
        folder.string());
  const auto tasks = slurm::tasks_of(job->number);
  if (!tasks) throw input_error("{}: whether its job {} still runs Slurm does not say", folder.string(), job->number);
  if (!std::all_of(tasks->begin(), tasks->end(), slurm::has_ended))
    throw input_error("{}: its job {} still waits or runs: scancel {} ends it", folder.string(), job->number,
                      job->number);
}

void check_keeps_read(const fs::path& folder, const std::vector<JobCase>& cases, const std::set<fs::path>& files) {
  const std::vector<fs::path> replaced{folder / job_files, folder / results_table};
  for (const fs::path& place : replaced) {
    check_none_is_in(place, files);
    for (const JobCase& one : cases) check_keeps_inputs(place, one.case_file);
  }
  for (const JobCase& one : cases) check_keeps_inputs(folder / one.name, one.case_file);
}

void begin_job(const fs::path& folder, const Job& job) {
  const fs::path files = folder / job_files;
  fs::create_directories(files);
  write_record(files / record_name, job);
  std::vector<fs::path> old{folder / results_table};
  for (const auto& entry : fs::directory_iterator(files))
    if (entry.path().filename() != record_name) old.push_back(entry.path());
  for (const fs::path& one : old) fs::remove_all(one);
  fs::create_directories(files / "ended");
}

}  // namespace tether
