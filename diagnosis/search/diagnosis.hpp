#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/search/diagnosis_report.hpp"

namespace tether {

/// What a diagnosis is told beside the case, by whoever knows what came of earlier ones.
struct DiagnosisSettings {
  std::vector<std::string> refused = {};  ///< numbers of candidates that are tested and not accepted
  double enough = 0;  ///< misfit beyond noise (lack_of_fit.excess) below which another effect must stand out at alpha/5
};

/// What makes the runs of a diagnosis.
struct DiagnosedModel {
  ModelRuns& runs;                       ///< of the case with all candidates at zero
  ModelRuns* coarse = nullptr;           ///< of a coarser model, for what numbers do to first order; null: `runs`
  std::vector<RefinedRun> refined = {};  ///< that tell what mesh and time step cost, or none
  /// Makes all models have these effects as well, at zero; none: effects act in regions and their parts only.
  std::function<void(const std::vector<PlacedEffect>& more)> extend = {};
};

/// What the model lacks: sets its runs against the data, to first order and then at finite amplitudes, and searches
/// (D.7-D.15). effects: what could be added. Throws what the runs throw.
DiagnosisReport diagnose(const DiagnosedCase& given, const std::vector<PlacedEffect>& effects,
                         const DiagnosedModel& model, const DiagnosisSettings& settings = {});

}  // namespace tether
