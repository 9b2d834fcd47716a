#include "diagnosis/evidence/sensitivities.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/error.hpp"
#include "common/config/rules.hpp"

namespace tether {
namespace {

using protocol::ParameterInfo;
using Words = std::vector<std::string>;

bool is_among(const std::string& name, const Words& words) {
  return std::find(words.begin(), words.end(), name) != words.end();
}

/// The value a step away: of what is or can be absent by its scale, of the others by their prior. Toward the other side
/// if this one is not admissible; nothing if neither is, or if the model does not say how far is far.
std::optional<double> stepped(const ParameterInfo& p, double step) {
  const bool is_absent = p.value == p.absent || (p.absent == 0 && p.scale > 0), is_log = p.transform.starts_with("log");
  for (const double side : {step, -step}) {
    double value = p.value + side * (is_absent ? p.scale : p.prior_deviation);
    if (!is_absent && is_log)
      value = p.value * std::pow(p.transform == "log2" ? 2 : std::exp(1), side * p.prior_deviation);
    if (std::isfinite(value) && value != p.value && value >= p.lower && value <= p.upper) return value;
  }
  return std::nullopt;
}

std::string effect_of(const ParameterInfo& p) {
  return p.name.substr(0, p.name.rfind('.'));
}

/// A gap, an angle: it shapes an effect that is switched off, and so does nothing.
bool is_idle(const ParameterInfo& p, const std::vector<ParameterInfo>& parameters) {
  if (p.absent == p.absent) return false;
  bool any = false;
  for (const ParameterInfo& other : parameters) {
    if (effect_of(other) != effect_of(p) || other.absent != other.absent) continue;
    if (other.value != other.absent) return false;
    any = true;
  }
  return any;
}

/// The number as such, or an effect that the case has switched off: its type, or its part of the wall.
bool is_excluded(const ParameterInfo& p, const std::vector<PlacedEffect>& effects, const Words& words) {
  if (is_among(p.name, words)) return true;
  return p.value == p.absent && std::any_of(effects.begin(), effects.end(), [&](const PlacedEffect& effect) {
           return effect.path == effect_of(p) && (is_among(effect.type, words) || is_among(effect.part, words));
         });
}

/// Words with a dot are numbers of the model; types and parts are the catalogue's.
void check_announced(const Words& known, const std::string& field, const Words& words, const CaseFile& file) {
  for (const std::string& word : words) {
    if (word.find('.') == std::string::npos || is_among(word, known)) continue;
    const std::string near = nearest(word, known);
    throw input_error("{}: the model has no number {}; {}", file.where(field), word,
                      near.empty() ? "it has " + listed(known) : fmt::format("did you mean {}?", near));
  }
}

std::string in_folder(const std::string& name) {
  return "candidates/runs/" + name;
}

}  // namespace

std::vector<VariedNumber> varied_numbers(const std::vector<ParameterInfo>& parameters,
                                         const std::vector<PlacedEffect>& effects, const DiagnosisCase& diagnosis,
                                         const CaseFile& file) {
  Words known;
  for (const ParameterInfo& p : parameters) known.push_back(p.name);
  check_announced(known, "diagnosis.exclude", diagnosis.exclude, file);
  check_announced(known, "diagnosis.assumed", diagnosis.assumed, file);
  std::vector<VariedNumber> varied;
  for (const ParameterInfo& p : parameters) {
    if (is_excluded(p, effects, diagnosis.exclude) || is_idle(p, parameters)) continue;
    if (const auto value = stepped(p, diagnosis.step)) varied.push_back({p, *value});
  }
  return varied;
}

WantedRun base_run() {
  return {in_folder("base"), {}};
}

Sensitivities sensitivities_of(ModelRuns& runs, const std::vector<VariedNumber>& varied) {
  Sensitivities all{{}, runs.make({base_run()})};
  if (all.motions.front().failed()) throw run_error("the model as it is: {}", all.motions.front().failure);
  add_sensitivities(all, runs, varied);
  return all;
}

std::vector<FinishedMotion> add_sensitivities(Sensitivities& all, ModelRuns& runs,
                                              const std::vector<VariedNumber>& more) {
  std::vector<WantedRun> wanted;
  for (const VariedNumber& one : more) wanted.push_back({in_folder(one.number.name), {{one.number.name}, {one.value}}});
  std::vector<FinishedMotion> motions = runs.make(wanted);
  all.varied.insert(all.varied.end(), more.begin(), more.end());
  all.motions.insert(all.motions.end(), motions.begin(), motions.end());
  return motions;
}

}  // namespace tether
