#include "diagnosis/explanation/path.hpp"

#include <algorithm>

#include "diagnosis/explanation/path_findings.hpp"
#include "diagnosis/explanation/path_sentences.hpp"

namespace tether {
namespace {

const PathModel& best_of(const ExplanationPath& path) {
  return path.models[path.best];
}

ExplanationCost cost_of(const std::vector<ExplainedStep>& steps) {
  ExplanationCost cost;
  for (const ExplainedStep& step : steps) {
    cost.cpu_seconds += step.cpu_seconds;
    cost.wall_seconds += step.wall_seconds;
  }
  return cost;
}

ExplainedModel told(const PathModel& model) {
  ExplainedModel told = model.told;
  told.case_file = model.folder() + ".yaml";
  told.run = model.folder();
  if (model.diagnosis) told.diagnosis = model.diagnosis_folder();
  told.reason = reason_of(told.objection);
  return told;
}

}  // namespace

std::size_t ExplanationPath::refused_since_best() const {
  return static_cast<std::size_t>(std::count_if(models.begin() + static_cast<long>(best) + 1, models.end(),
                                                [](const PathModel& model) { return !model.told.added.empty(); }));
}

const Diagnosis* first_diagnosis(const ExplanationPath& path) {
  const auto first = std::find_if(path.models.begin(), path.models.end(), [](const auto& m) { return m.diagnosis; });
  return first == path.models.end() ? nullptr : &*first->diagnosis;
}

std::optional<std::string> corrected_case(const ExplanationPath& path) {
  const PathModel& last = best_of(path);
  if (!last.diagnosis || !last.diagnosis->corrected_case) return std::nullopt;
  return last.diagnosis_folder() + "/" + *last.diagnosis->corrected_case;
}

bool is_settled(const ExplanationPath& path) {
  constexpr double kept = 0.8;  // of what was promised
  const auto made_by = std::find_if(path.models.rend() - static_cast<long>(path.best), path.models.rend(),
                                    [](const PathModel& model) { return model.told.accepted; });
  const Diagnosis& diagnosis = *made_by->diagnosis;
  if (diagnosis.more || diagnosis.doubtful || diagnosis.verdict == Verdict::not_in_catalogue) return false;
  const std::vector<Finding> added = accepted_of(diagnosis, false);
  const std::optional<Gain> foreseen = added.size() == 1 ? added.front().held_out_gain : diagnosis.held_out;
  const std::optional<Gain>& gain = best_of(path).told.gain;
  return !foreseen || !gain || gain->value > kept * foreseen->value;
}

void ask_otherwise(ExplanationPath& path, int left) {
  PathModel& model = path.models[path.best];
  if (model.diagnosis->more && model.at_once < left)
    ++model.at_once;
  else
    ask_for_one(path);
}

void ask_for_one(ExplanationPath& path) {
  PathModel& model = path.models[path.best];
  for (const Finding& effect : path.models.back().told.added)
    for (const FoundAmplitude& amplitude : effect.parameters) model.refused.push_back(amplitude.parameter);
  model.at_once = 1;
}

Verdict verdict_of(const ExplanationPath& path) {
  const Diagnosis& last = last_diagnosis(path);
  if (last.verdict == Verdict::not_in_catalogue) return last.verdict;
  const auto upheld = upheld_diagnoses(path);
  if (std::any_of(upheld.begin(), upheld.end(), [](const auto* d) { return d->verdict == Verdict::ambiguous; }))
    return Verdict::ambiguous;
  const bool is_open = last.verdict == Verdict::undecided && leaves_patterns(last);
  if (!found_on(path).empty() && !is_open) return Verdict::missing;
  if (path.was_last_refused()) return Verdict::undecided;  // what a diagnosis accepted was not confirmed
  return last.verdict;
}

Explanation explanation_of(const ExplanationPath& path) {
  Explanation e;
  e.case_name = path.case_name;
  e.title = path.title;
  e.case_file = path.case_file;
  e.verdict = verdict_of(path);
  e.statement = statement_of(path);
  e.sentences = sentences_of(path);
  for (const PathModel& model : path.models) e.models.push_back(told(model));
  e.best = best_of(path).told.number;
  e.effects = all_candidates(path);
  e.detectable = last_diagnosis(path).detectable;
  e.held_out = path.held_out;
  if (path.force) e.missing_force = "force/force.json";
  if (path.best > 0) e.suggested_case = best_of(path).folder() + ".yaml";
  e.corrected_case = corrected_case(path);
  e.cost = cost_of(path.steps);
  e.steps = path.steps;
  return e;
}

}  // namespace tether
