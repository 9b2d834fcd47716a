#include "batch/job_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "batch/job_status.hpp"
#include "common/base/error.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = "job.json";
constexpr const char* aside_name = ".job_before";  ///< no case's: no name begins with a dot
constexpr const char* way_out = "choose another folder with --output";

/// Whether a submission was killed that had set a job aside: put_back_job takes nobody's place then.
bool is_to_be_put_back(const fs::path& folder) {
  const fs::path aside = folder / aside_name;
  return fs::exists(aside / job_files) && !(fs::exists(aside / results_table) && fs::exists(folder / results_table));
}

/// A folder without a job. Nothing is lost with one that is empty.
void check_is_nobodys(const fs::path& folder) {
  if (is_to_be_put_back(folder)) return;
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
  if (job && is_perhaps_submitted(*job, folder)) {
    if (overwrite) return;
    throw input_error("{}: holds a job that was {}; scancel ends it, --output makes another, --overwrite replaces it",
                      folder.string(), perhaps_submitted(*job, folder));
  }
  if (!job || job->number.empty()) return;
  if (!overwrite)
    throw input_error(
        "{0}: holds a job; tether status {0} tells of it, --output makes another, --overwrite replaces it",
        folder.string());
  const auto tasks = slurm::tasks_of(job->number, job->cluster);
  if (!tasks)
    throw input_error("{}: whether its job {} still runs Slurm does not say", folder.string(), told_number(*job));
  if (!std::all_of(tasks->begin(), tasks->end(), slurm::has_ended))
    throw input_error("{}: its job {} still waits or runs: {} ends it", folder.string(), told_number(*job),
                      way_to_end(*job));
}

void check_keeps_read(const fs::path& folder, const std::vector<JobCase>& cases, const std::set<fs::path>& files) {
  const std::vector<fs::path> replaced{folder / job_files, folder / results_table};
  for (const fs::path& place : replaced) {
    check_none_is_in(place, files);
    for (const JobCase& one : cases) check_keeps_inputs(place, one.case_file);
  }
  for (const JobCase& one : cases) check_keeps_inputs(folder / one.name, one.case_file);
}

namespace {

/// Whether the new job was given to sbatch, or may have been.
bool is_in_its_place(const fs::path& folder) {
  const fs::path files = folder / job_files;
  if (!fs::exists(files / record_name)) return false;
  try {
    return fs::exists(files / submission_begun) || !read_job(folder).number.empty();
  } catch (const InputError&) {  // damaged since
    return true;
  }
}

}  // namespace

void put_back_job(const fs::path& folder) {
  const fs::path aside = folder / aside_name, files = folder / job_files;
  if (!fs::exists(aside / job_files) || is_in_its_place(folder)) return;
  fs::remove_all(files);
  for (const char* name : {results_table, job_files})  // the job last: a kill in between leaves it to be put back
    if (fs::exists(aside / name)) put_in_place(aside / name, folder / name);
  fs::remove_all(aside);
}

NewJob::NewJob(fs::path folder, const Job& job) : folder_(std::move(folder)) {
  const fs::path aside = folder_ / aside_name, files = folder_ / job_files;
  fs::remove_all(aside);  // of one that was replaced
  has_old_ = fs::exists(files / record_name);
  try {
    if (has_old_) {  // the job first: while it is aside put_back_job knows of what else is
      make_folder(aside);
      put_in_place(files, aside / job_files);
      if (fs::exists(folder_ / results_table)) put_in_place(folder_ / results_table, aside / results_table);
    }
    fs::create_directories(files / "ended");
    write_record(files / record_name, job);
  } catch (...) {
    put_back_job(folder_);
    throw;
  }
}

NewJob::~NewJob() {
  if (is_kept_ || !has_old_) return;
  std::error_code none;
  fs::remove(folder_ / job_files / record_name, none);
  try {
    put_back_job(folder_);
  } catch (const std::exception& error) {  // the next submission tries again
    fmt::print(stderr, "{}: the job that was there is in {}: {}\n", folder_.string(), aside_name, error.what());
  }
}

void NewJob::keep() {
  is_kept_ = true;
  std::error_code none;
  fs::remove_all(folder_ / aside_name, none);
}

slurm::Submitted NewJob::submit(const fs::path& script) {
  const fs::path mark = folder_ / job_files / submission_begun;
  write_whole(mark, "sbatch was asked, and its answer is not recorded\n");
  try {
    slurm::Submitted submitted = slurm::submit(script);
    keep();
    return submitted;
  } catch (const InputError& error) {
    fs::remove(mark);
    throw input_error("{}{}", error.what(), has_old_ ? "; the job that was there is kept" : "");
  } catch (const RunError& error) {
    keep();
    const Job job = read_job(folder_);
    throw run_error("{}; the job was {}, and if there is none, --overwrite submits it", error.what(),
                    perhaps_submitted(job, folder_));
  }
}

void NewJob::record(const Job& job) const {
  const fs::path files = folder_ / job_files;
  try {
    write_record(files / record_name, job);
  } catch (const RunError& error) {
    throw run_error("{}; job {} is submitted: {} ends it", error.what(), told_number(job), way_to_end(job));
  }
  fs::remove(files / submission_begun);
}

}  // namespace tether
