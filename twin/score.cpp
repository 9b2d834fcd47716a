#include "twin/score.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array verdicts{"nothing_missing", "missing", "ambiguous", "not_in_catalogue", "undecided"};

std::string place_of(const std::string& name, const std::string& where) {
  return where.empty() ? name : name + " at " + where;
}

std::string text_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return {};
  return found->is_string() ? found->get<std::string>() : found->dump();
}

double number_in(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? undefined : found->get<double>();
}

Diagnosis::Effect effect_of(const Json& json) {
  Diagnosis::Effect effect;
  effect.name = json.at("name");
  effect.where = text_in(json, "where");
  effect.group = text_in(json, "group");
  effect.accepted = json.value("accepted", false);
  const Json amplitude = json.value("amplitude", Json::object());
  effect.amplitude = number_in(amplitude, "value");
  effect.lower = number_in(amplitude, "lower");
  effect.upper = number_in(amplitude, "upper");
  effect.unit = text_in(amplitude, "unit");
  return effect;
}

Diagnosis diagnosis_of(const Json& json) {
  Diagnosis diagnosis;
  diagnosis.verdict = json.at("verdict");
  for (const Json& effect : json.at("effects")) diagnosis.effects.push_back(effect_of(effect));
  if (const auto held_out = json.find("held_out"); held_out != json.end() && !held_out->is_null()) {
    diagnosis.held_out_before = held_out->at("before").get<double>();
    diagnosis.held_out_after = held_out->at("after").get<double>();
  }
  return diagnosis;
}

bool is(const Diagnosis::Effect& found, const Answer::Effect& hidden) {
  return found.name == hidden.name && (hidden.where.empty() || found.where == hidden.where);
}

/// The group of an effect, if any of it was accepted.
bool in_accepted_group(const Diagnosis& diagnosis, const Diagnosis::Effect& effect) {
  return !effect.group.empty() && std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                                              [&](const auto& e) { return e.accepted && e.group == effect.group; });
}

FoundEffect found(const Diagnosis& diagnosis, const Answer::Effect& hidden) {
  FoundEffect result{hidden, 0, false, false, {}, {}};
  const auto effect =
      std::find_if(diagnosis.effects.begin(), diagnosis.effects.end(), [&](const auto& e) { return is(e, hidden); });
  if (effect == diagnosis.effects.end()) return result;
  result.rank = static_cast<int>(effect - diagnosis.effects.begin()) + 1;
  result.accepted = effect->accepted;
  result.in_accepted_group = in_accepted_group(diagnosis, *effect);
  if (effect->unit != hidden.unit || std::isnan(effect->amplitude)) return result;
  result.amplitude_error = effect->amplitude / hidden.amplitude - 1;
  if (!std::isnan(effect->lower) && !std::isnan(effect->upper))
    result.within_interval = effect->lower <= hidden.amplitude && hidden.amplitude <= effect->upper;
  return result;
}

bool is_right(const Score& score) {
  if (score.verdict != score.true_verdict) return false;
  const auto all = [&](auto holds) { return std::all_of(score.found.begin(), score.found.end(), holds); };
  if (score.verdict == "missing")
    return score.wrongly_accepted.empty() && all([](const FoundEffect& e) { return e.accepted; });
  if (score.verdict == "ambiguous") return all([](const FoundEffect& e) { return e.accepted || e.in_accepted_group; });
  return true;
}

Json maybe(const auto& value) {
  return value ? Json(*value) : Json();
}

std::string line_of(const FoundEffect& found) {
  std::string line = place_of(found.hidden.name, found.hidden.where) + ": ";
  if (found.rank == 0) return line + "not among the effects of the diagnosis\n";
  line += fmt::format("rank {}, {}", found.rank, found.accepted ? "accepted" : "not accepted");
  if (found.in_accepted_group && !found.accepted) line += ", its group is";
  if (found.amplitude_error) line += fmt::format(", amplitude {:+.1f} %", 100 * *found.amplitude_error);
  if (found.within_interval) line += *found.within_interval ? ", within its interval" : ", outside its interval";
  return line + "\n";
}

}  // namespace

Diagnosis read_diagnosis(const std::filesystem::path& file) {
  std::ifstream from(file);
  if (!from) throw input_error("{}: no such file; run tether diagnose first", file.string());
  Diagnosis diagnosis;
  try {
    diagnosis = diagnosis_of(Json::parse(from));
  } catch (const Json::exception& error) {
    throw input_error("{}: is no diagnosis: {}", file.string(), error.what());
  }
  if (std::find(verdicts.begin(), verdicts.end(), diagnosis.verdict) == verdicts.end())
    throw input_error("{}: verdict: {}: must be one of {}", file.string(), diagnosis.verdict,
                      fmt::join(verdicts, ", "));
  return diagnosis;
}

Score score_of(const Diagnosis& diagnosis, const Answer& answer) {
  Score score;
  score.verdict = diagnosis.verdict;
  score.true_verdict = answer.verdict;
  for (const auto& hidden : answer.effects) score.found.push_back(found(diagnosis, hidden));
  for (const auto& effect : diagnosis.effects)
    if (effect.accepted &&
        std::none_of(answer.effects.begin(), answer.effects.end(), [&](const auto& h) { return is(effect, h); }))
      score.wrongly_accepted.push_back(place_of(effect.name, effect.where));
  if (diagnosis.held_out_before && diagnosis.held_out_after)
    score.held_out_gain = 1 - *diagnosis.held_out_after / *diagnosis.held_out_before;
  score.verdict_right = is_right(score);
  return score;
}

std::string text_of(const Score& score) {
  std::string text = fmt::format("verdict: {}: {}", score.verdict, score.verdict_right ? "right" : "wrong");
  text += score.verdict == score.true_verdict ? "\n" : fmt::format(", the answer is {}\n", score.true_verdict);
  for (const FoundEffect& found : score.found) text += line_of(found);
  for (const std::string& effect : score.wrongly_accepted) text += effect + ": accepted, but was not hidden\n";
  if (score.held_out_gain) text += fmt::format("held-out distance: {:.1f} % less\n", 100 * *score.held_out_gain);
  return text;
}

void write_json(const std::filesystem::path& file, const Score& score) {
  Json effects = Json::array();
  for (const FoundEffect& e : score.found)
    effects.push_back({{"name", e.hidden.name},
                       {"where", e.hidden.where},
                       {"amplitude", e.hidden.amplitude},
                       {"unit", e.hidden.unit},
                       {"rank", e.rank > 0 ? Json(e.rank) : Json()},
                       {"accepted", e.accepted},
                       {"in_accepted_group", e.in_accepted_group},
                       {"amplitude_error", maybe(e.amplitude_error)},
                       {"within_interval", maybe(e.within_interval)}});
  const Json json{{"verdict", score.verdict},
                  {"true_verdict", score.true_verdict},
                  {"verdict_right", score.verdict_right},
                  {"effects", effects},
                  {"wrongly_accepted", score.wrongly_accepted},
                  {"held_out_gain", maybe(score.held_out_gain)}};
  std::ofstream to(file);
  to << json.dump(2) << "\n";
  to.close();
  if (!to) throw run_error("{} cannot be written", file.string());
}

}  // namespace tether
