#pragma once

#include "common/config/case_file.hpp"
#include "common/config/diagnosis_case.hpp"
#include "identification_master/group_pool.hpp"

namespace tether {

/// A whole run with one set of values.
struct DiagnosisRun {
  std::string folder;     ///< below the runs' folder: "base", "solid.support.regions.spine.stiffness"
  std::string parameter;  ///< the one that differs from the case; empty: none, or several
  NamedValues values;     ///< of all numbers that any run changes: a group keeps what it was last told
};

/// Which runs show what each number of the model does: the case as it is, and one for each number that may be wrong,
/// changed by `step` of its scale, or of its prior deviation where it is there already (D.7). Numbers that switch
/// nothing on and have no prior stay. Throws InputError if the case names a number that the model does not have.
std::vector<DiagnosisRun> sensitivity_runs(const std::vector<protocol::ParameterInfo>& parameters,
                                           const DiagnosisCase& diagnosis, const CaseFile& file);

/// The trials of the case. Throws InputError for a number that the model does not have.
std::vector<DiagnosisRun> trial_runs(const std::vector<protocol::ParameterInfo>& parameters,
                                     const DiagnosisCase& diagnosis, const CaseFile& file);

/// Makes those runs that are not in OUTPUT/runs yet for this very case and these values, and writes OUTPUT/runs.json:
/// runs, the model's numbers, cost (docs/diagnosis.md).
void make_runs(GroupPool& pool, const std::vector<DiagnosisRun>& runs, const CaseFile& file,
               const std::filesystem::path& output, std::int64_t steps, bool quiet);

}  // namespace tether
