#pragma once

#include <filesystem>
#include <string>

#include "batch/job.hpp"

namespace tether {

/// Seconds before the limit of time at which the programs are told to save their state and end: two minutes until they
/// are interrupted (end_limit), one for Slurm, which looks at its clock once a minute, and one to end in.
inline constexpr int seconds_to_end = 240;

/// By which squeue finds it: of its case, or of the folder of several.
std::string job_name(const Job& job, const std::filesystem::path& folder);

/// Of `--sbatch clusters=other`: "other"; empty: none is asked for.
std::string asked_clusters(const JobResources& resources);

/// The script that sbatch gets, for people to read and change: what is asked for, then one case, or for each task of an
/// array its own. Told to end (limit of time, preemption) it lets the programs save their state, and asks to be started
/// again where it ends with more saved than it began with; a job that a person cancels stays so.
/// Throws InputError for a folder that sbatch would not find by its name.
std::string job_script(const Job& job, const std::filesystem::path& folder);

}  // namespace tether
