#include "diagnosis/search/diagnosis_report.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/search/probability_table.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

std::optional<double> if_known(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}
std::optional<std::string> if_any(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

const Amplitude& amplitude_of(const EffectProblem& problem, const TestedEffect& effect, Index own) {
  const auto& amplitudes = problem.candidates[effect.candidate].amplitudes;
  return problem.amplitudes[static_cast<std::size_t>(amplitudes[static_cast<std::size_t>(own)])];
}

FoundAmplitude found_amplitude(const EffectProblem& problem, const TestedEffect& effect, Index own) {
  const Amplitude& amplitude = amplitude_of(problem, effect, own);
  const FoundValue found = value_of(problem, effect, own);
  return {amplitude.name, amplitude.meaning, found.value,    found.lower,
          found.upper,    amplitude.unit,    amplitude.base, effect.at_limit};
}

std::optional<LackOfFitFound> lack_of(const EffectProblem& problem, const LackOfFit& lack) {
  if (problem.pattern_names.empty()) return std::nullopt;
  const Pattern& worst = problem.pattern_names[lack.worst];
  return LackOfFitFound{lack.p, lack.excess, lack.beyond_noise, worst.region, worst.form, if_known(worst.time), lack.z};
}

Detectable detectable_of(const EffectProblem& problem, const TestedEffect& effect) {
  const Candidate& candidate = problem.candidates[effect.candidate];
  const Amplitude& first = amplitude_of(problem, effect, 0);
  return {candidate.name,
          candidate.where,
          first.name,
          first.value(effect.visible),
          first.unit,
          first.base,
          std::abs(effect.visible) / first.scale};
}

Attempt attempt_of(const EffectProblem& problem, const SearchStep& step) {
  const Candidate& candidate = problem.candidates[step.candidate];
  return {candidate.name,
          if_any(candidate.parameter),
          candidate.where,
          step.accepted(),
          step.objection,
          reason_of(step.objection),
          step.misfit_before,
          step.misfit_after,
          lack_of(problem, step.left)};
}

FurtherDatum further_datum(const Split& split) {
  return {split.measurement, split.assuming, split.difference, chance_to_tell(split.difference),
          split.difference >= telling};
}

std::optional<FurtherData> further_data(const std::vector<Split>& splits) {
  if (splits.empty()) return std::nullopt;
  FurtherData all{further_datum(splits.front()), {}};
  for (std::size_t i = 1; i < splits.size(); ++i) all.others.push_back(further_datum(splits[i]));
  return all;
}

/// Those that these data cannot tell from an accepted one, it first; of a sure verdict itself alone.
std::vector<std::string> alike_with(const Finding& accepted, const Diagnosis& diagnosis) {
  std::vector<std::string> alike{text_of(accepted)};
  if (diagnosis.verdict != Verdict::ambiguous) return alike;
  for (const Finding& other : diagnosis.effects)
    if (other.rival && other.group == accepted.group) alike.push_back(text_of(other));
  return alike;
}

Statement statement_of(const Diagnosis& diagnosis) {
  Statement statement;
  for (const Finding& finding : diagnosis.effects) {
    if (!finding.accepted) continue;
    std::vector<std::string> alike = alike_with(finding, diagnosis);
    if (alike.size() > 1)
      statement.alike.push_back(std::move(alike));
    else
      statement.add(finding.kind, std::move(alike.front()));
  }
  return statement;
}

}  // namespace

Eigen::Index main_amplitude(const EffectProblem& problem, const TestedEffect& effect) {
  Index best = 0;
  double most = -1;
  for (Index own = 0; own < effect.amplitudes.size(); ++own) {
    const double scale = amplitude_of(problem, effect, own).scale;
    const double size = std::abs(effect.amplitudes(own)) / (scale > 0 ? scale : 1);
    if (size > most) best = own, most = size;
  }
  return best;
}

Finding finding_of(const EffectProblem& problem, const TestedEffect& effect) {
  const Candidate& candidate = problem.candidates[effect.candidate];
  Finding finding;
  finding.name = candidate.name;
  finding.parameter = if_any(candidate.parameter);
  finding.where = candidate.where;
  finding.patch = candidate.extent.about;
  finding.meaning = candidate.meaning;
  finding.kind = candidate.kind;
  finding.source = if_any(candidate.data.field);
  finding.frame = if_known(candidate.data.frame);
  finding.accepted = effect.accepted;
  finding.rival = effect.rival;
  finding.testable = effect.testable;
  finding.z = effect.z;
  finding.p = effect.p;
  finding.q = effect.q;
  finding.amplitude = found_amplitude(problem, effect, main_amplitude(problem, effect));
  for (Index own = 0; own < effect.amplitudes.size(); ++own)
    finding.parameters.push_back(found_amplitude(problem, effect, own));
  finding.confirmed_by_runs = effect.confirmed;
  finding.misfit_removed = effect.confirmed ? effect.confirmed_gain : effect.gain;
  finding.retained_information = effect.retained;
  if (effect.group >= 0) finding.group = std::to_string(effect.group + 1);
  if (effect.group >= 0) finding.cosine = effect.cosine;
  finding.held_out_gain = effect.held_out;
  return finding;
}

FoundValue value_of(const EffectProblem& problem, const TestedEffect& effect, Index own) {
  const Amplitude& amplitude = amplitude_of(problem, effect, own);
  const double size = effect.amplitudes(own);
  if (size == 0) {
    const double half = two_sided_95 * effect.deviations(own);
    return {amplitude.value(0), amplitude.value(amplitude.one_sided ? 0 : -half), amplitude.value(half)};
  }
  const AmplitudeRange range = range_of(problem, effect, own);
  const auto [lower, upper] = std::minmax({amplitude.value(size * range.lower), amplitude.value(size * range.upper)});
  return {amplitude.value(size), lower, upper};
}

Diagnosis diagnosis_of(const DiagnosisReport& report) {
  const EffectProblem& problem = report.problem;
  const SearchResult& found = report.found;
  Diagnosis d;
  d.verdict = found.verdict;
  d.case_name = report.case_name;
  d.title = report.title;
  d.alpha = report.alpha;
  d.independent_data = found.independent;
  d.dispersion = found.dispersion;
  d.noise_factors = report.noise_factors;
  d.adequacy = found.adequacy;
  d.doubtful = found.doubtful;
  d.table = table_of(problem, found.weighed);
  for (const TestedEffect& effect : found.effects) {
    d.effects.push_back(finding_of(problem, effect));
    d.detectable.push_back(detectable_of(problem, effect));
  }
  d.look_alike = found.cosines;
  d.held_out = found.held_out;
  d.lack_of_fit = {lack_of(problem, found.before), lack_of(problem, found.after)};
  d.located = report.located;
  const auto is_on_it = [](const Finding& finding) { return finding.patch && (finding.accepted || finding.rival); };
  if (std::any_of(d.effects.begin(), d.effects.end(), is_on_it)) d.patch = report.patch;
  d.strained_errors = found.strained;
  d.noise = report.noise;
  d.more = found.more;
  d.faults_not_asked = report.faults_not_asked;
  d.published = report.published;
  d.split_by = further_data(report.splits);
  for (const SearchStep& step : found.path) d.path.push_back(attempt_of(problem, step));
  d.suggested_case = if_any(report.suggested);
  d.corrected_case = if_any(report.corrected);
  d.cost = report.cost;
  d.statement = statement_of(d);
  d.sentences = sentences_of(d);
  return d;
}

}  // namespace tether
