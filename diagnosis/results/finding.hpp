#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/catalogue/extent.hpp"
#include "common/io/record.hpp"
#include "diagnosis/results/gain.hpp"

namespace tether {

/// Of what a candidate changes.
enum class CandidateKind { effect, input, data, numerics };

template <>
inline constexpr auto words_of<CandidateKind> = std::to_array<WordOf<CandidateKind>>({
    {CandidateKind::effect, "effect", "physics that the model does not have"},
    {CandidateKind::input, "input", "a number of the model that may be wrong"},
    {CandidateKind::data, "data", "an error of the measurements"},
    {CandidateKind::numerics, "numerics", "a mesh or time step that is too coarse"},
});

/// A number of the model as it should be by the data.
struct FoundAmplitude {
  static constexpr const char* type_name = "amplitude";
  std::string parameter, meaning;
  double value = 0, lower = 0, upper = 0;
  std::string unit;
  double without = 0;
  bool at_limit = false;

  static void fields(auto& self, auto&& field) {
    field("parameter", self.parameter, "by its place in the case; of an error of the data its own name");
    field("meaning", self.meaning, "of the number");
    field("value", self.value, "with the effect, in `unit`");
    field("lower", self.lower, "of its 95 % interval");
    field("upper", self.upper, "of its 95 % interval");
    field("unit", self.unit, "of the values; 1: none");
    field("without", self.without, "the model's value before");
    field("at_limit", self.at_limit, "whether it would have to be larger than it may be");
  }
};

/// What the data say of one candidate: an effect at a place, an input, an error of the data or of the numerics.
struct Finding {
  static constexpr const char* type_name = "finding";
  std::string name;
  std::optional<std::string> parameter;
  std::string where, meaning;
  std::optional<Ball> patch;
  CandidateKind kind = CandidateKind::effect;
  std::optional<std::string> source;
  std::optional<double> frame;
  bool accepted = false, rival = false, testable = true;
  double z = 0, p = 1, q = 1;
  FoundAmplitude amplitude;
  std::vector<FoundAmplitude> parameters;
  bool confirmed_by_runs = false;
  double misfit_removed = 0, retained_information = 0;
  std::optional<std::string> group;
  std::optional<double> cosine;
  std::optional<Gain> held_out_gain;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the effect, input or error");
    field("parameter", self.parameter, "the only number of an effect that differs; null: all of them");
    field("where", self.where, "region of the wall, opening, or source and time of the data; empty: everywhere");
    field("patch", self.patch, "of the wall that it acts on; null: a region, or what `where` says");
    field("meaning", self.meaning, "of the effect");
    field("kind", self.kind, "what it changes");
    field("source", self.source, "of an error of the data, their section in the case");
    field("frame", self.frame, "of an error of one frame its number, as the case counts them");
    field("accepted", self.accepted, "the data ask for it");
    field("rival", self.rival, "these data cannot tell it from an accepted one");
    field("testable", self.testable, "the data would show it at a size that it may have");
    field("z", self.z, "significance of its gain, to first order");
    field("p", self.p, "probability that noise makes as much");
    field("q", self.q, "the same, corrected for the number of candidates");
    field("amplitude", self.amplitude, "the one of its numbers that says most");
    field("parameters", self.parameters, "all of its numbers");
    field("confirmed_by_runs", self.confirmed_by_runs, "the amplitudes are those of runs, not of first order");
    field("misfit_removed", self.misfit_removed, "at these amplitudes [chi-square]");
    field("retained_information", self.retained_information, "share that allowed errors cannot explain as well");
    field("group", self.group, "those that look alike have the same");
    field("cosine", self.cosine, "of its change of the model with that of the first of its group");
    field("held_out_gain", self.held_out_gain, "on data that the fit did not see");
  }
};

/// Whether it is no error of the data or of the numerics.
inline bool changes_model(const Finding& finding) {
  return finding.kind == CandidateKind::effect || finding.kind == CandidateKind::input;
}

/// "visco_elastic stiffness at spine".
std::string name_of(const Finding& finding);
/// "lower .. upper", or that the value is at its limit, or hardly known.
std::string interval_text(const FoundAmplitude& amplitude);
/// "contact at spine, factor 7 (3.5 .. 14)".
std::string text_of(const Finding& finding);
/// Of one whose size a few runs of a diagnosis say roughly: "contact at spine, factor about 7".
std::string rough_text_of(const Finding& finding);

}  // namespace tether
