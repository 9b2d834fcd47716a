#pragma once

#include <string>

#include "batch/job.hpp"

namespace tether {

/// How long a case is expected to take, and from what.
struct ExpectedTime {
  double seconds = 0;
  std::string from;  ///< "413 steps of 0.07 s"
};

/// By what a few steps took; of an identification by the number of its parameters. A diagnosis is taken for the longest
/// of those in docs/diagnosis-validation.md.
ExpectedTime expected_time(JobVerb verb, const MeasuredSteps& measured, int processes, int parameters);

/// What the job asks for where the user said nothing: memory for all models and a quarter more, twice the time.
void fill_from(const MeasuredSteps& measured, const ExpectedTime& expected, JobResources& resources);

/// Throws InputError for what cannot stand in a script, and for a time that leaves none to work in before the programs
/// are told to end.
void check_resources(const JobResources& resources);

/// For a person: what is asked for, and why.
std::string plan_text(const Job& job, const std::optional<ExpectedTime>& expected);

}  // namespace tether
