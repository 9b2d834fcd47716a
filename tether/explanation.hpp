#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/overlay.hpp"
#include "diagnosis/held_out_gain.hpp"

/// The path from a model to one that explains its measurements, as explain.json tells it (docs/explain.md).
namespace tether {

/// How far measured lumens are from a run, in root mean square.
struct Misfit {
  double length = 0;    ///< [length]
  double in_noise = 0;  ///< in the noise's deviation, of independent data
};

/// A model of the path: the case as given, or the one before it with what a diagnosis added.
struct ExplainedModel {
  int number = 0;
  std::string name;                    ///< "as given", "with visco_elastic at spine"
  std::vector<Overlay::Value> values;  ///< what it says otherwise than the case as given
  std::string added = "[]";            ///< JSON: entries of `effects` of diagnosis.json, with identified amplitudes
  bool accepted = true;
  std::string reason;  ///< why not
  Misfit training;
  std::optional<Misfit> held_out;
  std::optional<Gain> gain;          ///< on held-out data against the model before it
  std::string diagnosis = "null";    ///< diagnosis.json; "null": none was made
  std::vector<std::string> refused;  ///< numbers that a diagnosis of it accepted and an identification did not confirm
  bool identified = false;

  std::string folder() const { return "model_" + std::to_string(number); }
  std::string diagnosis_folder() const { return "diagnosis_" + std::to_string(number); }
  std::string identification_folder() const { return "identification_" + std::to_string(number); }
};

/// What a step took.
struct ExplainedStep {
  std::string name, folder;
  double wall_seconds = 0, cpu_seconds = 0;
  std::string key;  ///< of all that it depends on: a step with the same key need not be made again
};

struct Explanation {
  std::string case_name, title, case_file;  ///< case_file: relative to the output folder
  double millimetres = 1;                   ///< in the case's unit of length, for people
  std::vector<ExplainedModel> models;
  std::size_t best = 0;                 ///< the last one accepted
  double unexplained = 0.3;             ///< share of the first misfit beyond noise that may be left
  std::string force = "null";           ///< force.json; "null": none was sought
  std::vector<std::string> failure;     ///< where the model as given fails, as comparison.json says
  std::vector<std::string> odd_frames;  ///< sentences on frames that lie much farther off the best model than others
  std::optional<Gain> held_out;         ///< of the best model against the one as given
  std::vector<ExplainedStep> steps;
};

/// The entries of `effects` that a diagnosis accepted, of the model or errors of the data: JSON of JSON.
std::string accepted_effects(const std::string& diagnosis, bool of_data);

/// diagnosis.json of the first model that was diagnosed; "null": none was.
std::string first_diagnosis(const Explanation& explanation);

/// The case with its data corrected of the errors that the best model's diagnosis found, in the output folder; empty if
/// it found none, or none that a case can take off.
std::string corrected_case(const Explanation& explanation);

/// missing, nothing_missing, ambiguous, not_in_catalogue or undecided: of the whole path.
std::string verdict_of(const Explanation& explanation);

/// The verdict first, then what a person should know next, a sentence each.
std::vector<std::string> sentences_of(const Explanation& explanation);

/// Throws RunError if it cannot be written.
void write_json(const std::filesystem::path& file, const Explanation& explanation);

}  // namespace tether
