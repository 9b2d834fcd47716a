#pragma once

#include <filesystem>

#include "diagnosis/effect_search.hpp"
#include "diagnosis/further_measurement.hpp"

namespace tether {

/// What a diagnosis found, and what it took.
struct DiagnosisReport {
  std::string case_name, title;
  std::string suggested, corrected;  ///< cases with the effect, with corrected data; empty: none
  EffectProblem problem;
  SearchResult found;
  std::vector<Split> splits;  ///< what would tell rivals apart, the best first; empty if there are none
  double alpha = 0.05;
  int runs = 0, runs_made = 0;  ///< of the model; those that were not there yet
  int sensitivity_runs = 0;     ///< of these, the case as it is and what each number does to first order
  double cpu_seconds = 0;       ///< of the runs that were made
};

/// "visco_elastic at spine".
std::string name_of(const Candidate& candidate);

/// How a sentence begins that tells what does nearly the same as an accepted effect.
inline constexpr const char* much_like = "There is what does much the same as ";

/// The verdict first, then what a person should know next, a sentence each.
std::vector<std::string> sentences_of(const DiagnosisReport& report);

/// diagnosis.json (docs/diagnosis.md). Throws RunError if it cannot be written.
void write_json(const std::filesystem::path& path, const DiagnosisReport& report);

/// The number of an effect's amplitude that says most: the largest in its scale.
Eigen::Index main_amplitude(const EffectProblem& problem, const TestedEffect& effect);
/// Value of the model's number with the effect, and its 95 % interval; for one-sided amplitudes not below the base.
struct FoundValue {
  double value, lower, upper;
};
FoundValue value_of(const EffectProblem& problem, const TestedEffect& effect, Eigen::Index own);

/// "HEAD A from B, nor C from D; beside it E; THE DATA are off: F".
std::string ambiguity(const std::string& head, const std::vector<std::string>& unclear,
                      const std::vector<std::string>& beside, const std::vector<std::string>& wrong);

/// "lower .. upper", or that the value is at its limit, or hardly known.
std::string interval_text(const TestedEffect& effect, const FoundValue& found);

}  // namespace tether
