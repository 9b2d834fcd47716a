#pragma once

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/results/diagnosis.hpp"
#include "diagnosis/search/effect_search.hpp"
#include "diagnosis/search/further_measurement.hpp"

namespace tether {

/// What a diagnosis found, and what it took.
struct DiagnosisReport {
  std::string case_name, title;
  std::string suggested, corrected;  ///< cases with the effect, with corrected data; empty: none
  EffectProblem problem;
  std::vector<PlacedEffect> effects;  ///< that were candidates
  SearchResult found;
  std::vector<PublishedQuantities> published;  ///< what it changes
  std::vector<Split> splits;  ///< what would tell rivals apart, the best first; empty if there are none
  std::vector<NoiseCheck> noise;
  std::vector<std::string> faults_not_asked;
  LocatedMisfits located;
  std::optional<PatchPlace> patch;  ///< that a candidate acts on; none: regions explain what is there
  VectorXd misfit_map;  ///< z of patches about the nodes of the lumen, of what is left; empty: no data lie on it
  double alpha = 0.05;
  std::vector<NoiseFactor> noise_factors;
  DiagnosisCost cost;
};

/// What diagnosis.json says of it: names, units and values of the case in the place of candidates and amplitudes.
Diagnosis diagnosis_of(const DiagnosisReport& report);

/// What diagnosis.json says of one candidate.
Finding finding_of(const EffectProblem& problem, const TestedEffect& effect);

/// The number of an effect's amplitude that says most: the largest in its scale.
Eigen::Index main_amplitude(const EffectProblem& problem, const TestedEffect& effect);

/// Value of the model's number with the effect, and its 95 % interval; for one-sided amplitudes not below the base.
struct FoundValue {
  double value, lower, upper;
};
FoundValue value_of(const EffectProblem& problem, const TestedEffect& effect, Eigen::Index own);

}  // namespace tether
