#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// The scheduler, by its own programs.
namespace tether::slurm {

/// What sbatch answered to a script.
struct Submitted {
  std::string number;
  std::optional<std::string> cluster;  ///< whose number it is; nothing: that of this machine
  std::string doubt = {};              ///< how sbatch failed after it had told the number; empty: it did not
};

/// Gives a script to sbatch. Throws InputError with what sbatch says against it, or if there is no sbatch; RunError if
/// it ended without a number, or lost the scheduler on the way: nobody knows whether it has submitted the job.
Submitted submit(const std::filesystem::path& script);

/// What squeue says of a task of a job.
struct Task {
  int index = 0;       ///< in a job array; 0 of a job alone
  std::string state;   ///< "PENDING", "RUNNING", ...
  std::string reason;  ///< why it waits: "Resources"; empty: it does not
  std::string time;    ///< that it has run since its last start
  std::string nodes;   ///< on which it runs
};

/// What its state means. Unknown: a state that later versions of Slurm may have.
enum class Stage { waits, runs, ended, unknown };
Stage stage_of(const Task& task);
/// Whether it will run no more.
bool has_ended(const Task& task);

/// The tasks of a job that squeue still knows, also of those that have ended. Nothing if it cannot be asked.
std::optional<std::vector<Task>> tasks_of(const std::string& job, const std::optional<std::string>& cluster);

}  // namespace tether::slurm
