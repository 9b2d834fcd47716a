#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "diagnosis/diagnosis_report.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;
using Index = Eigen::Index;

const char* word_of(Candidate::Kind kind) {
  switch (kind) {
    case Candidate::Kind::effect:
      return "effect";
    case Candidate::Kind::input:
      return "input";
    case Candidate::Kind::data:
      return "data";
    case Candidate::Kind::numerics:
      return "numerics";
  }
  return "effect";
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

const Amplitude& amplitude_of(const EffectProblem& problem, const TestedEffect& effect, Index own) {
  const auto& amplitudes = problem.candidates[effect.candidate].amplitudes;
  return problem.amplitudes[static_cast<std::size_t>(amplitudes[static_cast<std::size_t>(own)])];
}

Json json_of(const EffectProblem& problem, const TestedEffect& effect, Index own) {
  const Amplitude& amplitude = amplitude_of(problem, effect, own);
  const FoundValue found = value_of(problem, effect, own);
  return {{"parameter", amplitude.name},  {"meaning", amplitude.meaning}, {"value", number(found.value)},
          {"lower", number(found.lower)}, {"upper", number(found.upper)}, {"unit", amplitude.unit},
          {"without", amplitude.base},    {"at_limit", effect.at_limit}};
}

Json json_of(const Gain& gain) {
  return {{"value", gain.value},
          {"lower", gain.lower},
          {"upper", gain.upper},
          {"before", gain.before},
          {"after", gain.after}};
}

Json json_of(const EffectProblem& problem, const TestedEffect& effect) {
  const Candidate& candidate = problem.candidates[effect.candidate];
  Json parameters = Json::array();
  for (Index own = 0; own < effect.amplitudes.size(); ++own) parameters.push_back(json_of(problem, effect, own));
  return {{"name", candidate.name},
          {"parameter", candidate.parameter.empty() ? Json() : Json(candidate.parameter)},
          {"where", candidate.where},
          {"meaning", candidate.meaning},
          {"kind", word_of(candidate.kind)},
          {"frame", number(candidate.data.frame)},
          {"accepted", effect.accepted},
          {"rival", effect.rival},
          {"testable", effect.testable},
          {"z", effect.z},
          {"p", effect.p},
          {"q", effect.q},
          {"amplitude", json_of(problem, effect, main_amplitude(problem, effect))},
          {"parameters", parameters},
          {"confirmed_by_runs", effect.confirmed},
          {"misfit_removed", effect.confirmed ? effect.confirmed_gain : effect.gain},
          {"retained_information", effect.retained},
          {"group", effect.group >= 0 ? Json(fmt::format("{}", effect.group + 1)) : Json()},
          {"cosine", effect.group >= 0 ? Json(effect.cosine) : Json()},
          {"held_out_gain", effect.held_out ? json_of(*effect.held_out) : Json()}};
}

const char* form_of(const Pattern& pattern) {
  return pattern.form == Pattern::Form::alike ? "alike" : pattern.form == Pattern::Form::ends ? "ends" : "end_to_end";
}

Json json_of(const EffectProblem& problem, const LackOfFit& lack) {
  if (problem.pattern_names.empty()) return nullptr;
  const Pattern& worst = problem.pattern_names[lack.worst];
  return {{"p", lack.p},
          {"excess", lack.excess},
          {"beyond_noise", lack.beyond_noise},
          {"worst_region", worst.region},
          {"worst_form", form_of(worst)},
          {"worst_time", number(worst.time)},
          {"worst_z", lack.z}};
}

Json detectable(const EffectProblem& problem, const std::vector<TestedEffect>& effects) {
  Json all = Json::array();
  for (const TestedEffect& effect : effects) {
    const Candidate& candidate = problem.candidates[effect.candidate];
    const Amplitude& first = amplitude_of(problem, effect, 0);
    all.push_back({{"name", candidate.name},
                   {"where", candidate.where},
                   {"parameter", first.name},
                   {"value", number(first.value(effect.visible))},
                   {"unit", first.unit},
                   {"without", first.base},
                   {"in_scale", number(effect.visible / first.scale)}});
  }
  return all;
}

Json rows_of(const MatrixXd& matrix) {
  Json rows = Json::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

Json path_of(const DiagnosisReport& report) {
  Json all = Json::array();
  for (const SearchStep& step : report.found.path) {
    const Candidate& candidate = report.problem.candidates[step.candidate];
    all.push_back({{"name", candidate.name},
                   {"where", candidate.where},
                   {"accepted", step.accepted},
                   {"reason", step.reason},
                   {"misfit_before", step.misfit_before},
                   {"misfit_after", step.misfit_after},
                   {"left", json_of(report.problem, step.left)}});
  }
  return all;
}

Json json_of(const Split& split) {
  return {{"measurement", split.measurement},
          {"assuming", split.assuming},
          {"expected_difference", split.difference},
          {"tells", split.difference >= telling}};
}

Json split_by(const std::vector<Split>& splits) {
  if (splits.empty()) return nullptr;
  Json json = json_of(splits.front());
  json["others"] = Json::array();
  for (std::size_t i = 1; i < splits.size(); ++i) json["others"].push_back(json_of(splits[i]));
  return json;
}

std::string split_sentence(const Split& best) {
  if (best.difference >= telling)
    return fmt::format("Measuring {} would tell them apart ({}: expected difference of the misfit {:.0f})",
                       best.measurement, best.assuming, best.difference);
  return fmt::format(
      "No pressure, no flow and no more or better frames would tell them apart; most would {} ({}: expected "
      "difference of the misfit {:.1f} of {:.0f} that it takes)",
      best.measurement, best.assuming, best.difference, telling);
}

/// Significant digits that a person reads.
std::string short_number(double value) {
  return fmt::format("{:.3g}", value);
}

std::string amplitude_text(const EffectProblem& problem, const TestedEffect& effect) {
  const Index own = main_amplitude(problem, effect);
  const Amplitude& amplitude = amplitude_of(problem, effect, own);
  const FoundValue found = value_of(problem, effect, own);
  const std::string name = amplitude.name.substr(amplitude.name.rfind('.') + 1);
  return fmt::format("{} {}{} ({})", name, short_number(found.value), amplitude.unit == "1" ? "" : " " + amplitude.unit,
                     interval_text(effect, found));
}

std::string where_left(const EffectProblem& problem, const LackOfFit& lack) {
  const Pattern& worst = problem.pattern_names[lack.worst];
  const std::string time = std::isnan(worst.time) ? "over the beat" : fmt::format("at {:.3g} s", worst.time);
  const char* form = worst.form == Pattern::Form::end_to_end ? " (inlet end, against the outlet end)"
                     : worst.form == Pattern::Form::ends     ? " (both ends, against the middle)"
                                                             : "";
  return fmt::format("{}{}, {}: the model lies too far {} ({:.1f} sigma)", worst.region, form, time,
                     lack.z < 0 ? "outward" : "inward", std::abs(lack.z));
}

std::vector<const TestedEffect*> accepted_of(const SearchResult& found) {
  std::vector<const TestedEffect*> all;
  for (const TestedEffect& effect : found.effects)
    if (effect.accepted) all.push_back(&effect);
  return all;
}

/// What was accepted, with its amount.
std::vector<std::string> named_of(const DiagnosisReport& report) {
  std::vector<std::string> named;
  for (const TestedEffect* effect : accepted_of(report.found))
    named.push_back(fmt::format("{}, {}", name_of(report.problem.candidates[effect->candidate]),
                                amplitude_text(report.problem, *effect)));
  return named;
}

std::string strained_text(const SearchResult& found) {
  std::vector<std::string> all;
  for (const StrainedError& error : found.strained)
    all.push_back(fmt::format("{} ({:.1f} times the deviation that is allowed)", error.name, error.deviations));
  return fmt::format("{}", fmt::join(all, "; "));
}

/// What does nearly the same as an accepted effect, though runs fit worse: where the model is wrong in more than one
/// way, that decides less than the numbers say. Empty if there is none.
std::string look_alike_text(const DiagnosisReport& report, const TestedEffect& accepted) {
  std::vector<std::string> alike;
  for (const TestedEffect& other : report.found.effects)
    if (other.group == accepted.group && other.group >= 0 && other.candidate != accepted.candidate && !other.rival &&
        other.confirmed)
      alike.push_back(fmt::format("{} ({:.0f} less)", name_of(report.problem.candidates[other.candidate]),
                                  accepted.confirmed_gain - other.confirmed_gain));
  if (alike.empty()) return "";
  return fmt::format("{}{}: its runs remove {:.0f} of the misfit, those of {}", much_like,
                     name_of(report.problem.candidates[accepted.candidate]), accepted.confirmed_gain,
                     fmt::join(alike, ", of "));
}

std::string refusal_text(const EffectProblem& problem, const SearchStep& step) {
  return fmt::format("{} stands out, but {}", name_of(problem.candidates[step.candidate]), step.reason);
}

std::string text_of(const EffectProblem& problem, const TestedEffect& effect) {
  return fmt::format("{}, {}", name_of(problem.candidates[effect.candidate]), amplitude_text(problem, effect));
}

/// What cannot be told from its rivals; then what is sure beside it.
std::string ambiguous_sentence(const DiagnosisReport& report) {
  std::vector<std::string> unclear, beside, wrong;
  for (const TestedEffect* effect : accepted_of(report.found)) {
    std::vector<std::string> alike{text_of(report.problem, *effect)};
    for (const TestedEffect& rival : report.found.effects)
      if (rival.rival && rival.group == effect->group) alike.push_back(text_of(report.problem, rival));
    const bool is_sure = alike.size() == 1;
    const bool of_data = report.problem.candidates[effect->candidate].kind == Candidate::Kind::data;
    (is_sure ? of_data ? wrong : beside : unclear).push_back(fmt::format("{}", fmt::join(alike, " from ")));
  }
  return ambiguity("AMBIGUOUS: these data cannot tell ", unclear, beside, wrong);
}

std::string verdict_sentence(const DiagnosisReport& report) {
  const EffectProblem& problem = report.problem;
  const SearchResult& found = report.found;
  const std::vector<std::string> named = named_of(report);
  const auto accepted = accepted_of(found);
  const auto all_are = [&](Candidate::Kind kind) {
    return std::all_of(accepted.begin(), accepted.end(),
                       [&](const TestedEffect* effect) { return problem.candidates[effect->candidate].kind == kind; });
  };
  if (found.verdict == "missing" && all_are(Candidate::Kind::data))
    return fmt::format("THE DATA are off{}: {}",
                       found.doubtful ? ", and more than chance is left beside" : ", the model lacks nothing beside",
                       fmt::join(named, "; and "));
  if (found.verdict == "missing" && all_are(Candidate::Kind::numerics))
    return fmt::format("THE NUMERICS are too coarse, no effect is missing: {}", fmt::join(named, "; and "));
  if (found.verdict == "missing") {
    std::vector<std::string> missing, wrong;
    for (std::size_t i = 0; i < named.size(); ++i)
      (problem.candidates[accepted[i]->candidate].kind == Candidate::Kind::data ? wrong : missing).push_back(named[i]);
    return fmt::format("MISSING: {}{}{}", fmt::join(missing, "; and "),
                       wrong.empty() ? "" : "; and THE DATA are off: ", fmt::join(wrong, "; and "));
  }
  if (found.verdict == "nothing_missing")
    return fmt::format(
        "NOTHING MISSING: no candidate explains {}, and what is left is within the noise and the errors allowed",
        found.path.empty() ? "more than chance"
                           : fmt::format("enough (the best, {}, might be more than chance)",
                                         name_of(problem.candidates[found.path.front().candidate])));
  if (found.verdict == "not_in_catalogue")
    return fmt::format("NOT IN THE CATALOGUE: something is missing that no candidate explains: {}",
                       where_left(problem, found.after));
  if (found.verdict == "ambiguous") return ambiguous_sentence(report);
  if (!found.path.empty()) return "UNDECIDED: " + refusal_text(problem, found.path.front());  // the best of them
  return found.doubtful ? "UNDECIDED: no candidate stands out, but the model is off by more than noise and the errors "
                          "allowed make by chance"
                        : "UNDECIDED: these data would not show any candidate at the size that it may have";
}

}  // namespace

std::string name_of(const Candidate& candidate) {
  const std::string name = candidate.parameter.empty() ? candidate.name : candidate.name + " " + candidate.parameter;
  return candidate.where.empty() ? name : name + " at " + candidate.where;
}

Index main_amplitude(const EffectProblem& problem, const TestedEffect& effect) {
  Index best = 0;
  double most = -1;
  for (Index own = 0; own < effect.amplitudes.size(); ++own) {
    const double scale = amplitude_of(problem, effect, own).scale;
    const double size = std::abs(effect.amplitudes(own)) / (scale > 0 ? scale : 1);
    if (size > most) best = own, most = size;
  }
  return best;
}

FoundValue value_of(const EffectProblem& problem, const TestedEffect& effect, Index own) {
  const Amplitude& amplitude = amplitude_of(problem, effect, own);
  const double size = effect.amplitudes(own), half = 1.96 * effect.deviations(own);
  if (!amplitude.one_sided) return {amplitude.value(size), amplitude.value(size - half), amplitude.value(size + half)};
  if (!effect.confirmed || size == 0)
    return {amplitude.value(size), amplitude.value(std::max(0.0, size - half)), amplitude.value(size + half)};
  const double factor = std::exp(half / size);  // of runs, its logarithm is known
  return {amplitude.value(size), amplitude.value(size / factor), amplitude.value(size * factor)};
}

std::string interval_text(const TestedEffect& effect, const FoundValue& found) {
  constexpr double anything = 1e4;  // between its ends
  if (found.lower > 0 && found.upper > anything * found.lower) return "hardly known";
  return effect.at_limit ? "its limit" : fmt::format("{} .. {}", short_number(found.lower), short_number(found.upper));
}

std::string ambiguity(const std::string& head, const std::vector<std::string>& unclear,
                      const std::vector<std::string>& beside, const std::vector<std::string>& wrong) {
  return fmt::format("{}{}{}{}{}{}", head, fmt::join(unclear, ", nor "), beside.empty() ? "" : "; beside it ",
                     fmt::join(beside, " and "),
                     wrong.empty() ? "" : "; THE DATA are off: ", fmt::join(wrong, " and "));
}

std::vector<std::string> sentences_of(const DiagnosisReport& report) {
  const SearchResult& found = report.found;
  std::vector<std::string> all{verdict_sentence(report)};
  if (found.verdict == "ambiguous" && !report.splits.empty()) all.push_back(split_sentence(report.splits.front()));
  if (found.held_out)
    all.push_back(fmt::format(
        "Held-out frames: {:.0f} % less distance ({:.0f} .. {:.0f}) with it, {:.2g} times the noise instead of {:.2g}",
        100 * found.held_out->value, 100 * found.held_out->lower, 100 * found.held_out->upper, found.held_out->after,
        found.held_out->before));
  else if (!accepted_of(found).empty())
    all.push_back("Not confirmed: no frames are held out");
  for (const TestedEffect& effect : found.effects)
    if (found.verdict == "missing" && effect.rival)
      all.push_back(fmt::format("These data cannot tell it from its variant {}, {}",
                                name_of(report.problem.candidates[effect.candidate]),
                                amplitude_text(report.problem, effect)));
  for (const TestedEffect* effect : accepted_of(found))
    if (std::string alike = look_alike_text(report, *effect); !alike.empty()) all.push_back(std::move(alike));
  if (found.dispersion > 1.5)
    all.push_back(
        fmt::format("The misfit that is left is {:.1f} times what noise makes: intervals are widened by its root, and "
                    "still optimistic",
                    found.dispersion));
  if (found.more)
    all.push_back(
        "More stands out beside it, which this diagnosis does not look for: refit it first, as tether explain does");
  if (found.verdict == "not_in_catalogue" && !named_of(report).empty())
    all.push_back(fmt::format("Closest, but not enough: {}", fmt::join(named_of(report), "; and ")));
  if (found.verdict == "not_in_catalogue" && !found.path.empty() && !found.path.back().accepted)
    all.push_back(refusal_text(report.problem, found.path.back()));
  if (found.verdict == "missing" && found.after.p < report.alpha / 5)
    all.push_back(fmt::format("Something smaller is left: {}", where_left(report.problem, found.after)));
  if (!found.strained.empty() && accepted_of(found).empty())
    all.push_back(fmt::format("Errors that are allowed would have to be large, see to them: {}", strained_text(found)));
  if (found.verdict == "undecided" && found.doubtful && !report.problem.pattern_names.empty())
    all.push_back(fmt::format("Farthest off: {}", where_left(report.problem, found.after)));
  return all;
}

void write_json(const std::filesystem::path& path, const DiagnosisReport& report) {
  const SearchResult& found = report.found;
  Json json{{"verdict", found.verdict},
            {"sentences", sentences_of(report)},
            {"case", report.case_name},
            {"title", report.title}};
  json["alpha"] = report.alpha;
  json["independent_data"] = found.independent;
  json["dispersion"] = found.dispersion;
  json["effects"] = Json::array();
  for (const TestedEffect& effect : found.effects) json["effects"].push_back(json_of(report.problem, effect));
  json["look_alike"] = rows_of(found.cosines);
  json["held_out"] = found.held_out ? json_of(*found.held_out) : Json();
  json["detectable"] = detectable(report.problem, found.effects);
  json["lack_of_fit"] = {{"before", json_of(report.problem, found.before)},
                         {"after", json_of(report.problem, found.after)}};
  json["more"] = found.more;
  json["split_by"] = split_by(report.splits);
  json["path"] = path_of(report);
  json["suggested_case"] = report.suggested.empty() ? Json() : Json(report.suggested);
  json["corrected_case"] = report.corrected.empty() ? Json() : Json(report.corrected);
  json["cost"] = {{"runs", report.runs},
                  {"sensitivity_runs", report.sensitivity_runs},
                  {"runs_made", report.runs_made},
                  {"cpu_seconds", report.cpu_seconds}};
  std::ofstream file(path);
  file << json.dump(1) << std::endl;
  if (!file) throw run_error("{} cannot be written", path.string());
}

}  // namespace tether
