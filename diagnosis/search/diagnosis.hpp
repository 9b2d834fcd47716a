#pragma once

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

/// What the model lacks: sets its runs against the data, to first order and then at finite amplitudes, and searches
/// (D.7-D.15). effects: what could be added. runs: of the case with all of them at zero. refined: runs that tell what
/// mesh and time step cost, or none. Throws what `runs` throws.
DiagnosisReport diagnose(const DiagnosedCase& given, const std::vector<PlacedEffect>& effects, ModelRuns& runs,
                         const std::vector<RefinedRun>& refined = {}, const DiagnosisSettings& settings = {});

}  // namespace tether
