#pragma once

#include <string>
#include <vector>

#include "batch/job.hpp"

namespace tether {

/// The work of a verb on a case, in runs.
struct PlannedRuns {
  MeasuredSteps model;
  std::optional<MeasuredSteps> coarser;  ///< of a diagnosis that has a coarser model
  std::vector<MeasuredSteps> finer;      ///< of a diagnosis that asks what numerics do: each runs once, at the least
  int first_order = 0;      ///< of a diagnosis: as it is, and one for each number, of the coarser model if there is one
  int least = 1, most = 1;  ///< what else takes as long as so many runs of the model
  int processes = 1;        ///< models at once
  int cores_of_model = 1;   ///< that one keeps busy
  int cores = 0;            ///< that these share; 0: each has one
};

/// Of a verb other than a diagnosis: of an identification a run of each particle. What a diagnosis does beside varying
/// numbers takes as long as in those of docs/diagnosis-validation.md: half of them at most `least`, the longest
/// `most`.
PlannedRuns planned_runs(JobVerb verb, int parameters);

/// How long that is expected to take [s].
struct ExpectedTime {
  double least = 0, most = 0;
};
ExpectedTime expected_time(const PlannedRuns& planned);

/// On that with most of them: a model stays on one.
int models_a_node(int models, int nodes);

/// [MB] a node: its models and a quarter more, and what stands beside them.
double expected_memory(const PlannedRuns& planned, int nodes);

/// What the job asks for where the user said nothing: that memory, twice the most time.
void fill_from(const PlannedRuns& planned, JobResources& resources);

/// Throws InputError for what cannot stand in a script, and for a time that leaves none to work in before the programs
/// are told to end.
void check_resources(const JobResources& resources);

/// For a person: what is asked for, and why. planned: null where nothing was measured.
std::string plan_text(const Job& job, const std::optional<PlannedRuns>& planned);
/// For a person: what the verb would take here.
std::string plan_text(JobVerb verb, const PlannedRuns& planned);

}  // namespace tether
