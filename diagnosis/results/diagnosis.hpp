#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/types.hpp"
#include "diagnosis/results/adequacy.hpp"
#include "diagnosis/results/finding.hpp"
#include "diagnosis/results/further_data.hpp"
#include "diagnosis/results/lack_of_fit.hpp"
#include "diagnosis/results/located_misfit.hpp"
#include "diagnosis/results/noise.hpp"
#include "diagnosis/results/patch_place.hpp"
#include "diagnosis/results/probability_table.hpp"
#include "diagnosis/results/published.hpp"
#include "diagnosis/results/statement.hpp"

namespace tether {

/// Beside a diagnosis, to go on with: the case with what was accepted, and with corrected data.
inline constexpr const char *suggested_file = "suggested.yaml", *corrected_file = "corrected.yaml";

/// The smallest value of a candidate that these data would show with 80 % probability.
struct Detectable {
  static constexpr const char* type_name = "detectable";
  std::string name, where, parameter;
  double value = 0;
  std::string unit;
  double without = 0, in_scale = 0;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the effect, input or error");
    field("where", self.where, "its place");
    field("parameter", self.parameter, "its number that would be seen first");
    field("value", self.value, "with the effect, in `unit`");
    field("unit", self.unit, "of the values; 1: none");
    field("without", self.without, "the model's value");
    field("in_scale", self.in_scale, "over the size that it may have in a patient");
  }
};

/// One attempt to add a candidate.
struct Attempt {
  static constexpr const char* type_name = "attempt";
  std::string name;
  std::optional<std::string> parameter;
  std::string where;
  bool accepted = false;
  std::optional<Objection> objection;
  std::string reason;
  double misfit_before = 0, misfit_after = 0;
  std::optional<LackOfFitFound> left;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the effect, input or error");
    field("parameter", self.parameter, "the only number of an effect that differs; null: all of them");
    field("where", self.where, "its place");
    field("accepted", self.accepted, "the data at hand and those held out ask for it");
    field("objection", self.objection, "why not");
    field("reason", self.reason, "the same in words");
    field("misfit_before", self.misfit_before, "[chi-square]");
    field("misfit_after", self.misfit_after, "[chi-square]");
    field("left", self.left, "lack of fit with it");
  }
};

/// An allowed error that the data ask for.
struct StrainedError {
  static constexpr const char* type_name = "strained_error";
  std::string name;
  double deviations = 0;
  std::optional<std::string> number;
  std::optional<double> value;
  std::string unit = "1";

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the error");
    field("deviations", self.deviations, "its size in the deviations that are allowed");
    field("number", self.number, "which of its numbers that is; null: it has none");
    field("value", self.value, "that the number would have to have, in `unit`; null: it has none");
    field("unit", self.unit, "of the value; 1: none");
  }
};

struct DiagnosisCost {
  static constexpr const char* type_name = "diagnosis_cost";
  int runs = 0, sensitivity_runs = 0, coarse_runs = 0, runs_made = 0;
  double cpu_seconds = 0;

  static void fields(auto& self, auto&& field) {
    field("runs", self.runs, "of the model that were used");
    field("sensitivity_runs", self.sensitivity_runs, "of these, the case as it is and what each number does");
    field("coarse_runs", self.coarse_runs, "of these, those of a coarser model");
    field("runs_made", self.runs_made, "of these, those that were not there yet");
    field("cpu_seconds", self.cpu_seconds, "of the runs that were made [s]");
  }
};

/// What a model lacks: diagnosis.json (docs/diagnosis.md).
struct Diagnosis {
  static constexpr const char* type_name = "diagnosis";
  Verdict verdict = Verdict::undecided;
  Statement statement;
  std::vector<std::string> sentences;
  std::string case_name, title;
  std::vector<std::string> data;
  double alpha = 0.05, independent_data = 0, dispersion = 1;
  std::vector<NoiseFactor> noise_factors;
  Adequacy adequacy;
  bool doubtful = false;
  ProbabilityTable table;
  std::vector<Finding> effects;
  MatrixXd look_alike;
  std::optional<Gain> held_out;
  std::vector<Detectable> detectable;
  LackOfFitChange lack_of_fit;
  LocatedMisfits located;
  std::optional<PatchPlace> patch;
  std::vector<StrainedError> strained_errors;
  std::vector<NoiseCheck> noise;
  bool more = false;
  std::vector<std::string> faults_not_asked;
  std::vector<PublishedQuantities> published;
  std::optional<FurtherData> split_by;
  std::vector<Attempt> path;
  std::optional<std::string> suggested_case, corrected_case;
  DiagnosisCost cost;

  static void fields(auto& self, auto&& field) {
    field("verdict", self.verdict, "what the data say of the model");
    field("statement", self.statement, "what was found, of which the first sentence is made");
    field("sentences", self.sentences, "the verdict first, then what a person should know next");
    field("case", self.case_name, "name of the case");
    field("title", self.title, "of the case");
    field("data", self.data, "hashes of what the files of the measurements held");
    field("alpha", self.alpha, "probability of a false alarm over all candidates");
    field("independent_data", self.independent_data, "number of independent training data");
    field("dispersion", self.dispersion, "misfit left per independent datum; intervals are widened by its root");
    field("noise_factors", self.noise_factors, "of each source, how large it is as the data say (D.20)");
    field("adequacy", self.adequacy, "probability that chance leaves as much, asked in five ways (D.20)");
    field("doubtful", self.doubtful, "more is left than noise and errors allowed make by chance");
    field("table", self.table, "how probable each explanation is");
    field("effects", self.effects, "accepted ones first, then by their evidence");
    field("look_alike", self.look_alike, "cosines of what the first of `effects` change, each with each other");
    field("held_out", self.held_out, "on held-out data, by all that was accepted");
    field("detectable", self.detectable, "per candidate, in the order of `effects`");
    field("lack_of_fit", self.lack_of_fit, "of the model as it is, and with what was accepted");
    field("located", self.located, "where on the wall the misfit is largest, whatever the regions");
    field("patch", self.patch,
          "of the wall on which effects were tried beside regions; null: none was needed, or helped");
    field("strained_errors", self.strained_errors, "allowed errors that would have to be large, the worst first");
    field("noise", self.noise, "what the case states of it, held against what the accepted model leaves, by source");
    field("more", self.more, "another effect is wanted, but no more were to be added");
    field("faults_not_asked", self.faults_not_asked,
          "faults that instruments of these data can have, and that compete only where `diagnosis.also` names them");
    field("published", self.published,
          "what is published of a vessel, in the model as it is, then with what was accepted, then rivals");
    field("split_by", self.split_by, "what would tell rivals apart");
    field("path", self.path, "attempts in their order");
    field("suggested_case", self.suggested_case, "file beside this one: the case with what was accepted");
    field("corrected_case", self.corrected_case, "file beside this one: the case with its data corrected");
    field("cost", self.cost, "of the diagnosis");
  }
};

/// Whether some region, moment or form is farther off than noise and errors allowed make any of them by chance, with
/// the probability alpha/5 (D.11), or a place than any noise does (D.24).
bool leaves_patterns(const Diagnosis& diagnosis);
/// The accepted ones that change the model, or those that are errors of data or numerics.
std::vector<Finding> accepted_of(const Diagnosis& diagnosis, bool of_data);

/// The first sentence: the verdict, and what it is about.
std::string headline_of(const Diagnosis& diagnosis);
/// Of an undecided one what stands out and is not confirmed, or why nothing can be said: its headline's second part.
std::string open_question_of(const Diagnosis& diagnosis);
/// What does much the same as an accepted effect, a sentence each.
std::vector<std::string> look_alike_sentences(const Diagnosis& diagnosis);
/// Whether the diagnosis tells its gain on held-out data, or an explanation tells its own in its place.
enum class HeldOutGain { told, left_out };
/// What a person should know beside the headline.
std::vector<std::string> remarks_on(const Diagnosis& diagnosis, HeldOutGain gain);
/// The headline and all remarks.
std::vector<std::string> sentences_of(const Diagnosis& diagnosis);

}  // namespace tether
