#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/case_file.hpp"
#include "common/config/input_watch.hpp"
#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/evidence/diagnosis_case.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "observation_manager/measurements/observed_case.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {

/// A case with measurements whose noise is stated.
struct DiagnosedCase {
  /// Throws InputError if there are none, or if the noise of one is not given.
  explicit DiagnosedCase(const std::filesystem::path& path);
  /// Whether runs of a finer step and mesh compete with the effects.
  bool asks_numerics() const;

  InputWatch inputs;  ///< since before they were read
  CaseFile file;
  MeshCase mesh;
  ObservationsCase observations;
  DiagnosisCase diagnosis;
  LumenSurface lumen;
  Observations data;
};

/// Data against the model as it is, what each candidate and each allowed error does to first order. base: the run of
/// the model as it is.
EffectProblem problem_of(const DiagnosedCase& given, const Evidence& evidence, const FinishedMotion& base,
                         const Sensitivities& sensitivities, const std::vector<PlacedEffect>& effects);

/// Data minus model of each run, a column each; where a run has no datum as `otherwise` [n]. NaN for a run that failed.
MatrixXd residuals_of(const Evidence& evidence, const std::vector<FinishedMotion>& motions, const VectorXd& otherwise);

}  // namespace tether
