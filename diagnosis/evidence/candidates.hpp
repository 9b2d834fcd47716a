#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/catalogue/extent.hpp"
#include "common/config/case_file.hpp"
#include "common/config/overlay.hpp"
#include "diagnosis/evidence/diagnosis_case.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/placed_effect.hpp"
#include "diagnosis/evidence/sensitivities.hpp"

namespace tether {

/// Whether a code of the case is Tether's own: a program named without slash. One of somebody else's has no catalogue
/// and takes no effects; the numbers that it announces are candidates.
bool has_catalogue(const std::string& code, const CaseFile& file);

/// What the programs say could be missing, and what the case has; restricted as the case wants it. Throws
/// InputError with the program's message.
std::vector<PlacedEffect> catalogue_of(const CaseFile& file, const DiagnosisCase& diagnosis);

/// Throws InputError if the case's section `diagnosis`, if there is one, names what is not there.
void check_diagnosis(const std::filesystem::path& case_file);

/// The case with every candidate at the value at which it does nothing: the model whose runs a diagnosis asks for.
void write_candidates(const std::filesystem::path& file, const CaseFile& from, const Observations& data,
                      const std::vector<PlacedEffect>& effects);

/// What a case must say of the part of its place in which an effect acts.
void add_extent(Overlay& overlay, const PlacedEffect& effect);

/// What runs of a model with one number changed each show.
struct ModelChanges {
  const std::vector<VariedNumber>& varied;
  MatrixXd residuals;      ///< of the model as it is, then one column for each of `varied`
  bool is_coarse = false;  ///< of a coarser model
};

/// Adds what the runs show: the change of all data per amplitude, and what its number is called. (D.7)
void add_model_changes(EffectProblem& problem, const ModelChanges& changes, const std::vector<PlacedEffect>& effects,
                       const DiagnosisCase& diagnosis);

}  // namespace tether
