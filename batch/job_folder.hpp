#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "batch/job.hpp"

/// The folder that a job is written into: what stands there already, and what of it may go.
namespace tether {

/// Throws InputError if a job of this folder would replace what tether submit did not make, a job that is not to be
/// replaced, or one that still waits or runs. A damaged record is replaced if asked for, beside what else a job has.
void check_replaced(const std::filesystem::path& folder, bool overwrite);

/// Throws InputError if a job of this folder would replace one of these files, what a case is read from, or, by the
/// results of a case, what that is read from.
void check_keeps_read(const std::filesystem::path& folder, const std::vector<JobCase>& cases,
                      const std::set<std::filesystem::path>& files);

/// Replaces what an earlier job left in the folder by this one's record. That is written first: whatever happens then,
/// the folder is known to hold a job.
void begin_job(const std::filesystem::path& folder, const Job& job);

}  // namespace tether
