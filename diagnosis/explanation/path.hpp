#pragma once

#include "common/config/overlay.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"

/// The path from a model to one that explains its measurements, while it is walked.
namespace tether {

/// A model of the path, and what is known of it.
struct PathModel {
  ExplainedModel told;                 ///< as explain.json has it
  std::vector<Overlay::Value> values;  ///< what it says otherwise than the case as given
  std::optional<Diagnosis> diagnosis;
  std::vector<std::string> refused;  ///< numbers that a diagnosis of it accepted and an identification did not confirm
  int asked = 0;                     ///< diagnoses of it; `diagnosis` is the last one
  int at_once = 1;                   ///< effects that the next one may add

  std::string folder() const { return "model_" + std::to_string(told.number); }
  std::string diagnosis_folder() const {
    return "diagnosis_" + std::to_string(told.number) + (asked > 1 ? "_" + std::to_string(asked) : "");
  }
  std::string identification_folder() const { return "identification_" + std::to_string(told.number); }
};

struct ExplanationPath {
  std::string case_name, title, case_file;  ///< case_file: relative to the output folder
  double millimetres = 1;                   ///< in the case's unit of length, for people
  std::vector<PathModel> models;
  std::size_t best = 0;      ///< the last one accepted
  double unexplained = 0.3;  ///< share of the first misfit beyond noise that may be left
  std::optional<ForceFound> force;
  std::vector<std::string> failure;     ///< where the model as given fails, as comparison.json says
  std::vector<std::string> odd_frames;  ///< sentences on frames that lie much farther off the best model than others
  std::optional<Gain> held_out;         ///< of the best model against the one as given
  std::vector<ExplainedStep> steps;

  /// Models that diagnoses asked for, tried since the best one and not kept. That the case's own parameters, once
  /// identified, make no better model refuses nothing that a diagnosis said.
  std::size_t refused_since_best() const;
  bool was_last_refused() const { return refused_since_best() > 0; }
};

/// The diagnosis of the first model that has one; null: none was made.
const Diagnosis* first_diagnosis(const ExplanationPath& path);

/// Whether the diagnosis that the best model was made by foresaw that nothing but noise would be left, and the model
/// keeps what it promised. What is left beside a strong effect is for runs about the model that has it: what other
/// candidates do was known about the model before.
bool is_settled(const ExplanationPath& path);

/// What the best model's next diagnosis is asked, since what the last one accepted was not confirmed: for one effect
/// more at once where it said that another stands out beside it, whose lack held-out data may have judged, and `left`
/// may be added; else for others than what was tried.
void ask_otherwise(ExplanationPath& path, int left);
/// It was asked for several at once and found fewer: for one at a time again, and others than what was tried.
void ask_for_one(ExplanationPath& path);

/// Of the whole path.
Verdict verdict_of(const ExplanationPath& path);

/// The case with its data corrected of the errors that the best model's diagnosis found, in the output folder; none if
/// it found none, or none that a case can take off.
std::optional<std::string> corrected_case(const ExplanationPath& path);

/// What explain.json says of it. At least one model was diagnosed.
Explanation explanation_of(const ExplanationPath& path);

}  // namespace tether
