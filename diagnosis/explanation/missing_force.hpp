#pragma once

#include "common/config/overlay.hpp"
#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/stored_run.hpp"
#include "diagnosis/results/missing_force.hpp"

namespace tether {

/// What remains when nothing in the catalogue explains the data: the traction itself, along the normal, one in each
/// region of the wall, that walks at random in time; then the law that it may follow (D.14).
class MissingForce {
 public:
  /// values: what the best model says otherwise than the given case. folder: for results, "force".
  MissingForce(const DiagnosedCase& given, std::vector<Overlay::Value> values, std::filesystem::path folder);

  /// What to say beside the given case to identify the tractions.
  std::vector<Overlay::Value> identification() const;

  /// What to say beside the given case to have the tractions that were identified: formulas of time. Reads
  /// FOLDER/walk/estimate.csv.
  std::vector<Overlay::Value> with_tractions();

  /// Tractions over time and their laws, from the motion of the run in FOLDER/run; and writes FOLDER/suggested.yaml,
  /// the case with those laws that a formula can state.
  ForceFound laws() const;

 private:
  ForceLaw law_of_traction(const RegionForce& traction, const StoredRun& run) const;
  double prior_deviation() const;

  const DiagnosedCase& given_;
  std::vector<Overlay::Value> values_;
  std::filesystem::path folder_;
  std::vector<RegionForce> tractions_;  ///< `parameter`: the name of the effect too
};

}  // namespace tether
