#include "tether/explanation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/base/error.hpp"
#include "diagnosis/diagnosis_report.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

bool is_diagnosed(const ExplainedModel& model) {
  return model.diagnosis != "null";
}

Json accepted(const Json& diagnosis, bool of_data) {
  Json all = Json::array();
  for (const Json& effect : diagnosis["effects"])
    if (effect["accepted"] && (effect["kind"] == "data" || effect["kind"] == "numerics") == of_data)
      all.push_back(effect);
  return all;
}

const ExplainedModel& best_of(const Explanation& e) {
  return e.models[e.best];
}

std::string name_of(const Json& effect) {
  std::string name = effect["name"];
  if (!effect["parameter"].is_null()) name += " " + effect["parameter"].get<std::string>();
  const std::string where = effect["where"];
  return where.empty() ? name : name + " at " + where;
}

std::string amplitude_text(const Json& effect) {
  const Json& a = effect["amplitude"];
  const std::string parameter = a["parameter"];
  const auto number = [&](const char* key) {
    return a[key].is_null() ? "?" : fmt::format("{:.3g}", a[key].get<double>());
  };
  const std::string unit = a["unit"];
  const bool at_limit = a.value("at_limit", false);
  return fmt::format("{} {}{} ({})", parameter.substr(parameter.rfind('.') + 1), number("value"),
                     unit == "1" ? "" : " " + unit,
                     at_limit ? "its limit" : fmt::format("{} .. {}", number("lower"), number("upper")));
}

/// All that was added on the way to the best model, and errors of the data that were named.
Json found_of(const Explanation& e) {
  Json all = Json::array();
  for (std::size_t i = 0; i <= e.best; ++i) {
    if (!e.models[i].accepted) continue;
    for (const Json& effect : Json::parse(e.models[i].added)) all.push_back(effect);
    if (!is_diagnosed(e.models[i])) continue;
    for (const Json& effect : accepted(Json::parse(e.models[i].diagnosis), true)) all.push_back(effect);
  }
  return all;
}

/// The last diagnosis that was made of an accepted model.
Json last_diagnosis(const Explanation& e) {
  for (std::size_t i = e.best + 1; i-- > 0;)
    if (is_diagnosed(e.models[i])) return Json::parse(e.models[i].diagnosis);
  return nullptr;
}

/// Diagnoses on the way to the best model, but not one whose finding was not confirmed.
std::vector<Json> upheld_diagnoses(const Explanation& e) {
  std::vector<Json> all;
  const bool last_was_refused = e.models.size() > e.best + 1;
  for (std::size_t i = 0; i <= e.best; ++i)
    if (is_diagnosed(e.models[i]) && (i < e.best || !last_was_refused))
      all.push_back(Json::parse(e.models[i].diagnosis));
  return all;
}

bool any_ambiguous(const Explanation& e) {
  const auto diagnoses = upheld_diagnoses(e);
  return std::any_of(diagnoses.begin(), diagnoses.end(),
                     [](const Json& diagnosis) { return diagnosis["verdict"] == "ambiguous"; });
}

std::string text_of(const Json& effect) {
  return fmt::format("{}, {}", name_of(effect), amplitude_text(effect));
}

/// Of one that was not identified: a few runs of a diagnosis say its size roughly.
std::string rough_text_of(const Json& effect) {
  const Json& a = effect["amplitude"];
  const std::string parameter = a["parameter"], unit = a["unit"];
  return fmt::format("{}, {} about {:.2g}{}{}", name_of(effect), parameter.substr(parameter.rfind('.') + 1),
                     a["value"].get<double>(), unit == "1" ? "" : " " + unit,
                     a.value("at_limit", false) ? " (its limit)" : "");
}

/// What the data cannot tell apart, as identified where it was; then what was found beside it.
std::string ambiguous_sentence(const Explanation& e) {
  Json found = found_of(e);
  std::vector<std::string> unclear, beside, wrong;
  const auto take = [&](const Json& effect) {  // as it was found in the end; nothing if it was not
    const auto identified =
        std::find_if(found.begin(), found.end(), [&](const Json& other) { return name_of(other) == name_of(effect); });
    if (identified == found.end()) return std::string();
    const std::string text = text_of(*identified);
    found.erase(identified);
    return text;
  };
  for (const Json& diagnosis : upheld_diagnoses(e))
    for (const Json& effect : diagnosis["effects"]) {
      if (!effect["accepted"]) continue;
      const std::string name = take(effect);
      std::vector<std::string> alike{name.empty() ? rough_text_of(effect) : name};
      for (const Json& rival : diagnosis["effects"])
        if (rival["rival"] && rival["group"] == effect["group"] && !effect["group"].is_null())
          alike.push_back(rough_text_of(rival));
      const bool is_sure = alike.size() == 1, of_data = effect["kind"] == "data";
      (is_sure ? of_data ? wrong : beside : unclear).push_back(fmt::format("{}", fmt::join(alike, " from ")));
    }
  for (const Json& effect : found) (effect["kind"] == "data" ? wrong : beside).push_back(text_of(effect));
  return ambiguity("AMBIGUOUS: these data cannot tell ", unclear, beside, wrong);
}

/// Whether all that was found are errors of the data or of the numerics.
bool is_no_physics(const Explanation& e, const char* kind) {
  const Json found = found_of(e);
  return std::all_of(found.begin(), found.end(), [&](const Json& effect) { return effect["kind"] == kind; });
}

std::string verdict_sentence(const Explanation& e) {
  const std::string verdict = verdict_of(e);
  std::vector<std::string> found;
  for (const Json& effect : found_of(e)) found.push_back(text_of(effect));
  if (verdict == "missing" && (is_no_physics(e, "data") || is_no_physics(e, "numerics")))
    return last_diagnosis(e)["sentences"][0];
  if (verdict == "missing") return fmt::format("MISSING: {}", fmt::join(found, "; and "));
  if (verdict == "ambiguous") return ambiguous_sentence(e);
  if (e.models.size() > e.best + 1)
    return fmt::format("UNDECIDED: {} stands out, but {}", e.models.back().name, e.models.back().reason);
  const std::string last = last_diagnosis(e)["sentences"][0];
  return found.empty() ? last : fmt::format("{}; beside {}", last, fmt::join(found, " and "));
}

/// Single frames that diagnoses found wrong, if the path went on without them.
std::vector<std::string> left_out_of(const Explanation& e) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < e.best; ++i)
    if (is_diagnosed(e.models[i]))
      for (const Json& error : accepted(Json::parse(e.models[i].diagnosis), true))
        if (!error.value("frame", Json()).is_null()) all.push_back(name_of(error));
  return all;
}

std::string held_out_sentence(const Explanation& e) {
  const ExplainedModel &first = e.models.front(), &last = best_of(e);
  return fmt::format(
      "Held-out frames: {:.2g} mm away from the model as given, {:.2g} mm from the one with what was added: {:.0f} % "
      "less "
      "({:.0f} .. {:.0f}); {:.1f} times the noise is left",
      e.millimetres * first.held_out->length, e.millimetres * last.held_out->length, 100 * e.held_out->value,
      100 * e.held_out->lower, 100 * e.held_out->upper, last.held_out->in_noise);
}

Json json_of(const Misfit& misfit) {
  return {{"l2", misfit.length}, {"in_noise", misfit.in_noise}};
}

Json json_of(const Gain& gain) {
  return {{"value", gain.value},
          {"lower", gain.lower},
          {"upper", gain.upper},
          {"before", gain.before},
          {"after", gain.after}};
}

Json json_of(const ExplainedModel& model) {
  Json json{{"number", model.number},
            {"name", model.name},
            {"case", model.folder() + ".yaml"},
            {"run", model.folder()},
            {"diagnosis", is_diagnosed(model) ? Json(model.diagnosis_folder()) : Json()},
            {"identification", model.identified ? Json(model.identification_folder()) : Json()}};
  json["added"] = Json::parse(model.added);
  json["accepted"] = model.accepted;
  json["reason"] = model.reason;
  json["training"] = json_of(model.training);
  json["held_out"] = model.held_out ? json_of(*model.held_out) : Json();
  json["held_out_gain"] = model.gain ? json_of(*model.gain) : Json();
  return json;
}

/// What was found first, with identified amplitudes, then the others of the last diagnosis by their evidence.
Json all_effects(const Explanation& e) {
  Json all = found_of(e);
  const auto is_known = [&](const Json& effect) {
    return std::any_of(all.begin(), all.end(), [&](const Json& known) { return name_of(known) == name_of(effect); });
  };
  std::vector<Json> others;
  for (std::size_t i = e.best + 1; i-- > 0;)
    if (is_diagnosed(e.models[i]))
      for (const Json& effect : Json::parse(e.models[i].diagnosis)["effects"])
        if (!is_known(effect)) all.push_back(effect);
  return all;
}

}  // namespace

std::string first_diagnosis(const Explanation& e) {
  const auto first = std::find_if(e.models.begin(), e.models.end(), is_diagnosed);
  return first == e.models.end() ? "null" : first->diagnosis;
}

std::string accepted_effects(const std::string& diagnosis, bool of_data) {
  return accepted(Json::parse(diagnosis), of_data).dump();
}

std::string corrected_case(const Explanation& e) {
  const ExplainedModel& last = best_of(e);
  if (!is_diagnosed(last)) return "";
  const Json diagnosis = Json::parse(last.diagnosis);
  return diagnosis["corrected_case"].is_null()
             ? ""
             : last.diagnosis_folder() + "/" + diagnosis["corrected_case"].get<std::string>();
}

std::string verdict_of(const Explanation& e) {
  const Json last = last_diagnosis(e);
  if (last["verdict"] == "not_in_catalogue") return "not_in_catalogue";
  if (any_ambiguous(e)) return "ambiguous";
  if (!found_of(e).empty()) return "missing";
  if (e.models.size() > e.best + 1) return "undecided";  // what a diagnosis accepted was not confirmed
  return last["verdict"];
}

std::vector<std::string> sentences_of(const Explanation& e) {
  std::vector<std::string> all{verdict_sentence(e)};
  if (e.held_out && e.best > 0) all.push_back(held_out_sentence(e));
  if (const std::string corrected = corrected_case(e); !corrected.empty())
    all.push_back(
        fmt::format("Is it so? Then look again without these errors of the data: tether explain {}", corrected));
  for (const std::string& sentence : e.failure) all.push_back("The model as given: " + sentence);
  const Json last = last_diagnosis(e);
  for (std::size_t i = 1; i < last["sentences"].size(); ++i) {
    const std::string sentence = last["sentences"][i];
    if (!sentence.starts_with("Held-out")) all.push_back(sentence);
  }
  for (const Json& diagnosis : upheld_diagnoses(e))
    if (diagnosis != last)
      for (const std::string sentence : diagnosis["sentences"])
        if (sentence.starts_with(much_like)) all.push_back(sentence);
  if (last["verdict"] == "undecided" && !found_of(e).empty()) {
    const std::string first = last["sentences"][0], word = "UNDECIDED: ";
    all.push_back("Beside what was found: " + (first.starts_with(word) ? first.substr(word.size()) : first));
  }
  for (const std::string& frame : left_out_of(e))
    all.push_back("Wrong, and left out where values were found: " + frame);
  for (const std::string& frame : e.odd_frames) all.push_back(frame);
  if (e.models.size() > e.best + 1)
    all.push_back(fmt::format("Tried and not kept: {}: {}", e.models.back().name, e.models.back().reason));
  if (const Json force = Json::parse(e.force); !force.is_null())
    for (const Json& sentence : force["sentences"]) all.push_back(sentence);
  return all;
}

void write_json(const std::filesystem::path& path, const Explanation& e) {
  Json json{{"case", e.case_name}, {"title", e.title}, {"case_file", e.case_file}};
  json["verdict"] = verdict_of(e);
  json["sentences"] = sentences_of(e);
  json["models"] = Json::array();
  for (const ExplainedModel& model : e.models) json["models"].push_back(json_of(model));
  json["best"] = best_of(e).number;
  json["effects"] = all_effects(e);
  json["detectable"] = last_diagnosis(e)["detectable"];
  json["held_out"] = e.held_out ? json_of(*e.held_out) : Json();
  json["missing_force"] = e.force == "null" ? Json() : Json("force/force.json");
  json["suggested_case"] = e.best > 0 ? Json(best_of(e).folder() + ".yaml") : Json();
  const std::string corrected = corrected_case(e);
  json["corrected_case"] = corrected.empty() ? Json() : Json(corrected);
  const auto sum = [&](double ExplainedStep::*part) {
    return std::accumulate(e.steps.begin(), e.steps.end(), 0.0,
                           [&](double all, const ExplainedStep& step) { return all + step.*part; });
  };
  json["cost"] = {{"cpu_seconds", sum(&ExplainedStep::cpu_seconds)},
                  {"wall_seconds", sum(&ExplainedStep::wall_seconds)}};
  json["steps"] = Json::array();
  for (const ExplainedStep& step : e.steps)
    json["steps"].push_back({{"name", step.name},
                             {"folder", step.folder},
                             {"wall_seconds", step.wall_seconds},
                             {"cpu_seconds", step.cpu_seconds},
                             {"key", step.key}});
  std::ofstream file(path);
  file << json.dump(1) << std::endl;
  if (!file) throw run_error("{} cannot be written", path.string());
}

}  // namespace tether
