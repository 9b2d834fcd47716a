#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "batch/job.hpp"
#include "batch/slurm.hpp"

/// The folder that a job is written into: what stands there already, and what of it may go.
namespace tether {

/// Throws InputError if a job of this folder would replace what tether submit did not make, a job that is not to be
/// replaced, one that was perhaps submitted among them, or one that still waits or runs. A damaged record is replaced
/// if asked for, beside what else a job has.
void check_replaced(const std::filesystem::path& folder, bool overwrite);

/// Throws InputError if a job of this folder would replace one of these files, what a case is read from, or, by the
/// results of a case, what that is read from.
void check_keeps_read(const std::filesystem::path& folder, const std::vector<JobCase>& cases,
                      const std::set<std::filesystem::path>& files);

/// Puts back what a new job was about to replace, if that was ended before sbatch was asked. Of a folder that is held.
void put_back_job(const std::filesystem::path& folder);

/// A job that takes the place of what an earlier one left in the folder, which stands aside until the new one is kept,
/// and comes back if it is not. The record is written first: whatever happens then, the folder is known to hold a job.
class NewJob {
 public:
  NewJob(std::filesystem::path folder, const Job& job);
  ~NewJob();
  NewJob(const NewJob&) = delete;
  NewJob& operator=(const NewJob&) = delete;

  /// The old one goes.
  void keep();
  /// Gives the job's script to sbatch. The number is to be recorded, and the job is kept then, as is one of which
  /// nobody knows whether it was submitted: is_perhaps_submitted. Throws as slurm::submit does.
  slurm::Submitted submit(const std::filesystem::path& script);
  /// With its number. Throws RunError with the number where it cannot be recorded.
  void record(const Job& job) const;

 private:
  std::filesystem::path folder_;
  bool has_old_, is_kept_ = false;
};

}  // namespace tether
