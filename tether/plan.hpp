#pragma once

#include <filesystem>
#include <string>

#include "batch/job_plan.hpp"
#include "common/config/command_line.hpp"

namespace tether {

/// Throws InputError for what is wrong with a case, or not there, for this verb; what other verbs read is not asked
/// for.
void check_case_for(JobVerb verb, const std::filesystem::path& case_file);

/// How many models of a case are worth running at once.
int models_at_once(JobVerb verb, const std::filesystem::path& case_file);

/// What the verb would do with a case, of which a few steps are made here, and of its coarser model. processes: models
/// at once. Throws RunError if the steps fail.
PlannedRuns planned_of(JobVerb verb, const std::filesystem::path& case_file, int processes);

/// For a person: tether VERB CASE.yaml --plan.
std::string plan_of(JobVerb verb, const CommandLine& command);

template <JobVerb verb>
std::string plan(const CommandLine& command) {
  return plan_of(verb, command);
}

}  // namespace tether
