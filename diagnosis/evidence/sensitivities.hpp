#pragma once

#include <vector>

#include "common/config/case_file.hpp"
#include "diagnosis/evidence/diagnosis_case.hpp"
#include "diagnosis/evidence/model_runs.hpp"
#include "diagnosis/evidence/placed_effect.hpp"

namespace tether {

/// A number of the model, and the value that shows what it does.
struct VariedNumber {
  protocol::ParameterInfo number;
  double value = 0;
};

/// What each number of the model does, by a run for each, and by one of the model as it is.
struct Sensitivities {
  std::vector<VariedNumber> varied;
  std::vector<FinishedMotion> motions;  ///< the model as it is first; then one for each of `varied`
  bool is_coarse = false;               ///< they are of a coarser model
};

/// The numbers that may be wrong, changed by `step` of their scale, or of their prior deviation where they are there
/// already (D.7). Numbers that switch nothing on and have no prior stay, and so does what is excluded: numbers, and
/// those by which one of `effects` that is excluded would be switched on. Throws InputError if the case names a number
/// that the model does not have.
std::vector<VariedNumber> varied_numbers(const std::vector<protocol::ParameterInfo>& parameters,
                                         const std::vector<PlacedEffect>& effects, const DiagnosisCase& diagnosis,
                                         const CaseFile& file);

/// The model as it is.
WantedRun base_run();

/// Makes these runs, in candidates/runs. Throws RunError if the model as it is does not come to its end: without it
/// there is nothing to compare with.
Sensitivities sensitivities_of(ModelRuns& runs, const std::vector<VariedNumber>& varied);
/// Makes a run for each of these as well, and adds it; returns the motions of these alone.
std::vector<FinishedMotion> add_sensitivities(Sensitivities& all, ModelRuns& runs,
                                              const std::vector<VariedNumber>& more);

}  // namespace tether
