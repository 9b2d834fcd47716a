#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// The scheduler, by its own programs.
namespace tether::slurm {

/// Gives a script to sbatch; returns the job's number. Throws InputError with what sbatch says against it, or
/// if there is none; RunError if it ended without an answer: nobody knows whether it has submitted it.
std::string submit(const std::filesystem::path& script);

/// What squeue says of a task of a job.
struct Task {
  int index = 0;       ///< in a job array; 0 of a job alone
  std::string state;   ///< "PENDING", "RUNNING", ...
  std::string reason;  ///< why it waits: "Resources"; empty: it does not
  std::string time;    ///< that it has run since its last start
  std::string nodes;   ///< on which it runs
};

/// Whether it will run no more.
bool has_ended(const Task& task);

/// The tasks of a job that squeue still knows, also of those that have ended. Nothing if it cannot be asked.
std::optional<std::vector<Task>> tasks_of(const std::string& job);

}  // namespace tether::slurm
