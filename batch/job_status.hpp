#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "batch/job.hpp"
#include "batch/slurm.hpp"

namespace tether {

enum class CaseState { unsubmitted, waiting, running, done, failed, gone, unknown };

template <>
inline constexpr auto words_of<CaseState> = std::to_array<WordOf<CaseState>>({
    {CaseState::unsubmitted, "not submitted", "a script was written only"},
    {CaseState::waiting, "waiting", "for its turn, the first time or to go on"},
    {CaseState::running, "running", "on a node"},
    {CaseState::done, "done", "its results are there"},
    {CaseState::failed, "failed", "its log says why"},
    {CaseState::gone, "gone", "it left the scheduler before its end: cancelled, or its node was lost"},
    {CaseState::unknown, "unknown",
     "it has not ended, and the scheduler does not answer, or what it says of it or left of it cannot be read"},
});

struct CaseStatus {
  std::string name;
  CaseState state = CaseState::waiting;
  std::string note;  ///< why it waits, where and how long it runs, the last line of its log
};

/// The job of a folder. Throws InputError if it holds none, or one whose record was changed to what no job has: its
/// names are those of folders in this one, and are shown.
Job read_job(const std::filesystem::path& folder);

/// In a job's folder of files while sbatch is asked, until its answer is recorded.
inline constexpr const char* submission_begun = "submission_begun";

/// Whether its submission was begun and no number is known of it, by nobody.
bool is_perhaps_submitted(const Job& job, const std::filesystem::path& folder);
/// "perhaps submitted: squeue --me --name=tether-tube tells"
std::string perhaps_submitted(const Job& job, const std::filesystem::path& folder);
/// "4711", "4711 of cluster other"
std::string told_number(const Job& job);
/// "scancel 4711", "scancel -M other 4711"
std::string way_to_end(const Job& job);

/// What became of each case of a job, from what the scheduler says (nothing: it cannot be asked) and the job's folder.
std::vector<CaseStatus> status_of(const Job& job, const std::filesystem::path& folder,
                                  const std::optional<std::vector<slurm::Task>>& tasks);

/// "12 cases: 3 done, 4 running, 5 waiting", and a line for each.
std::string text_of(const std::vector<CaseStatus>& cases);

}  // namespace tether
