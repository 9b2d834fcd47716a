#include "report/collect.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "common/base/base64.hpp"
#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/results/comparison.hpp"
#include "diagnosis/results/explanation.hpp"
#include "diagnosis/results/missing_force.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "identification_master/results/estimate.hpp"
#include "report/estimate_table.hpp"
#include "report/provenance.hpp"
#include "report/result_folder.hpp"
#include "report/run_sentences.hpp"
#include "report/wall.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// By name.
std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.path().extension() == ".png") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

bool is_there(const fs::path& path) {
  std::error_code none;
  return fs::exists(fs::symlink_status(path, none));
}

/// Without the groups of single contours: the page shows regions.
void drop_contours(Json& groups) {
  Json kept = Json::array();
  for (Json& group : groups)
    if (group.at("series").is_null()) kept.push_back(std::move(group));
  groups = std::move(kept);
}

Json regions_only(Json comparison) {
  if (comparison.is_null()) return comparison;
  for (Json& source : comparison.at("sources")) {
    for (const char* kind : {"training", "held_out"}) drop_contours(source.at(kind).at("all_frames"));
    for (Json& moment : source.at("moments")) {
      drop_contours(moment.at("groups"));
      moment.erase("frames");
    }
  }
  return comparison;
}

/// What a reader asks of a run: all but the whole case.
Json facts_of(Json summary) {
  if (!summary.is_null()) summary.erase("effective_case");
  return summary;
}

/// "The diagnosis of model 0"
std::string titled(const std::string& what, const std::string& label) {
  return label.empty() ? what : what + " of " + label;
}

/// A folder with a compared run, as the page shows it.
struct ShownRun {
  std::string label;
  fs::path folder;
  Json comparison;
};

/// Units of the case that people in a clinic do not use: {"g/(cm s2)": {"unit": "mmHg", "factor": 0.00075}}.
Json clinical_units(const UnitSystem& units) {
  Json json;
  json[units.symbol(dimension::pressure)] = {{"unit", "mmHg"}, {"factor", units.to_mmhg(1)}};
  json[units.symbol(dimension::flow)] = {{"unit", "ml/s"}, {"factor", units.to_ml_per_s(1)}};
  json[units.symbol(dimension::velocity)] = {{"unit", "m/s"}, {"factor", units.in_si(dimension::velocity)}};
  return json;
}

class Collector {
 public:
  explicit Collector(fs::path folder) : folder_(std::move(folder)), files_(folder_) {
    document_ = {{"made", {{"version", version()}, {"commit", commit()}, {"date", date_now()}}},
                 {"title", ""},
                 {"case", ""},
                 {"kind", nullptr},
                 {"verdict", nullptr},
                 {"sentences", Json::array()},
                 {"explain", nullptr},
                 {"runs", Json::array()},
                 {"diagnoses", Json::array()},
                 {"estimates", Json::array()},
                 {"force", nullptr},
                 {"plots", Json::array()},
                 {"wall", nullptr},
                 {"provenance", nullptr},
                 {"warnings", Json::array()},
                 {"remarks", Json::array()},
                 {"notes", Json::array()}};
  }

  Json document() {
    const Json explain = result<Explanation>(folder_ / "explain.json");
    if (explain.is_null())
      take_folder();
    else
      take_explained(explain);
    if (document_["kind"].is_null())
      throw input_error("{}: holds no explain.json, comparison.json, diagnosis.json, estimate.json or summary.json",
                        folder_.string());
    if (!shown_.empty()) document_["wall"] = wall();
    document_["provenance"] = provenance();
    return std::move(document_);
  }

 private:
  /// The folder of one verb.
  void take_folder() {
    take_estimate("", "");
    take_diagnosis("", "");
    take_run("the model", "");
    if (document_["kind"].is_null()) take_simulation();
    case_file_ = case_of_results(folder_);
  }

  /// A run that was compared with nothing.
  void take_simulation() {
    if (!is_there(folder_ / "summary.json")) return;
    files_.check_holds(folder_ / "summary.json");
    const auto run = read_record<RunSummary>(folder_ / "summary.json");
    introduce("simulation", {{"title", run.title}, {"case", run.case_name}, {"sentences", sentences_of(run)}});
    for (const fs::path& plot : pictures_in(folder_ / "plots"))
      if (const Json picture = embedded(plot); !picture.is_null())
        document_["plots"].push_back({{"name", plot.stem().string()}, {"png", picture}});
  }

  void take_explained(const Json& explain) {
    const Json& models = explain.at("models");
    const Json *given = &models.at(0), *best = given;
    check_named(explain, "missing_force");
    for (const Json& model : models) {
      for (const char* folder : {"run", "diagnosis", "identification"}) check_named(model, folder);
      if (model.at("number") == explain.at("best")) best = &model;
      const std::string name = fmt::format("model {}", model.at("number").get<int>());
      if (const Json& at = model.at("diagnosis"); at.is_string()) take_diagnosis(at, name);
      if (const Json& at = model.at("identification"); at.is_string()) take_estimate(at, name);
    }
    const std::string before = given->at("name");
    take_run(best == given ? before : "before: " + before, given->at("run"));
    if (best != given) take_run("after: " + best->at("name").get<std::string>(), best->at("run"));
    if (const Json& force = explain.value("missing_force", Json()); force.is_string()) take_force(force);
    case_file_ = folder_ / given->at("case").get<std::string>();
    introduce("explain", explain);
    document_["explain"] = explain;
  }

  /// A force without a law, and the model with it.
  void take_force(const std::string& name) {
    document_["force"] = result<ForceFound>(folder_ / name);
    const fs::path run = fs::path(name).parent_path() / "run";
    if (is_there(folder_ / run / "comparison.json")) take_run("with the force that is missing", run.string(), true);
  }

  /// What the whole is called and what it says.
  void introduce(const char* kind, const Json& from) {
    document_["kind"] = kind;
    for (const char* key : {"title", "case", "verdict", "sentences"})
      if (from.contains(key)) document_[key] = from[key];
    if (document_["title"] == "") document_["title"] = document_["case"];
  }

  void take_run(const std::string& label, const std::string& name, bool forced = false) {
    const fs::path folder = folder_ / name;
    const Json comparison = result<ComparisonResult>(folder / "comparison.json");
    if (comparison.is_null()) {
      if (!name.empty()) note("{} holds no comparison.json", name);
      return;
    }
    if (name.empty()) introduce("comparison", comparison);
    dated_.emplace_back(titled("The comparison", label), folder / "comparison.json");
    const UnitSystem units = UnitSystem::named(comparison.at("units").at("system").get<std::string>());
    shown_.push_back({label, folder, comparison});
    document_["runs"].push_back({{"label", label},
                                 {"folder", name},
                                 {"forced", forced},
                                 {"mm", units.to_mm(1)},
                                 {"clinical", clinical_units(units)},
                                 {"comparison", regions_only(comparison)}});
  }

  void take_diagnosis(const std::string& name, const std::string& label) {
    const Json diagnosis = result<Diagnosis>(folder_ / name / "diagnosis.json");
    if (diagnosis.is_null()) return;
    if (name.empty()) introduce("diagnosis", diagnosis);
    dated_.emplace_back(titled("The diagnosis", label), folder_ / name / "diagnosis.json");
    const fs::path misfit = folder_ / name / "plots/misfit.png";
    const Json picture = is_there(misfit) ? embedded(misfit) : Json();
    document_["diagnoses"].push_back(
        {{"label", label}, {"folder", name}, {"diagnosis", diagnosis}, {"misfit", picture}});
  }

  void take_estimate(const std::string& name, const std::string& label) {
    const fs::path folder = folder_ / name;
    const Json estimate = result<Estimate>(folder / "estimate.json");
    if (estimate.is_null()) return;
    if (name.empty()) introduce("estimate", estimate);
    take_remarks(estimate.at("notices"));
    dated_.emplace_back(titled("The identification", label), folder / "estimate.json");
    std::vector<std::string> names;
    for (const Json& parameter : estimate.at("parameters")) names.push_back(parameter.at("name"));
    Json over_time;
    try {
      files_.check_holds(folder / "estimate.csv");
      over_time = Json::parse(estimate_over_time(folder / "estimate.csv", names));
    } catch (const InputError& error) {
      note("no estimates over time: {}", error.what());
    }
    document_["estimates"].push_back(
        {{"label", label}, {"folder", name}, {"estimate", estimate}, {"over_time", over_time}});
  }

  /// The moving lumen of the runs shown; null, with a note, if it cannot be had.
  Json wall() {
    try {
      std::vector<fs::path> folders;
      for (const ShownRun& run : shown_) {
        files_.check_holds(run.folder / "wall.json");
        folders.push_back(run.folder);
      }
      return Json::parse(json_of(wall_of(folders)));
    } catch (const InputError& error) {
      note("The moving wall is not shown: {}", error.what());
      return nullptr;
    }
  }

  Json provenance() {
    Json json{{"cases", Json::array()}, {"runs", Json::array()}, {"files", Json::array()}, {"seeds", Json::array()}};
    if (shown_.empty()) add_facts(json, folder_, "");
    for (const ShownRun& run : shown_) add_facts(json, run.folder, run.label);
    if (!case_file_) return json;
    try {
      const CaseInputs inputs = inputs_of(*case_file_);
      for (const auto& file : inputs.files)
        json["files"].push_back({{"field", file.field},
                                 {"name", file.name},
                                 {"bytes", file.bytes},
                                 {"modified", file.modified},
                                 {"changed", is_changed(file)}});
      warn_of_other_data(inputs);
      for (const auto& seed : inputs.seeds) json["seeds"].push_back({{"field", seed.field}, {"value", seed.value}});
    } catch (const InputError& error) {
      note("The files of the case are not listed: {}", error.what());
    }
    return json;
  }

  /// Whether a file holds something else than when the run began.
  bool is_changed(const CaseInputs::File& file) const {
    const auto then = recorded_.find(file.field);
    return then != recorded_.end() && !then->second.contains(file.content);
  }

  /// Results of several verbs stand in one folder, and may be of other measurements than the case has by now.
  void warn_of_other_data(const CaseInputs& inputs) {
    for (const auto& [what, result] : dated_)
      for (const auto& file : inputs.files)
        if (file.field.starts_with("observations.") && is_changed(file) &&
            (came_after(file.path, result) || came_after(*case_file_, result))) {
          document_["warnings"].push_back(fmt::format("{} is of other data: {} was changed since", what, file.name));
          break;
        }
  }

  void add_facts(Json& json, const fs::path& folder, const std::string& label) {
    try {
      if (is_there(folder / case_as_run))
        json["cases"].push_back({{"label", label}, {"text", files_.content(folder / case_as_run)}});
    } catch (const InputError& error) {
      note("A case is not shown: {}", error.what());
    }
    const Json facts = facts_of(result<RunSummary>(folder / "summary.json"));
    if (facts.is_null()) return;
    json["runs"].push_back({{"label", label}, {"finished", date_of(folder / "summary.json")}, {"summary", facts}});
    take_remarks(facts.at("notices"));
    for (const Json& file : facts.at("made_from").at("files")) recorded_[file.at("field")].insert(file.at("content"));
  }

  /// Of several runs of one case, each once.
  void take_remarks(const Json& notices) {
    Json& all = document_["remarks"];
    for (const Json& notice : notices)
      if (std::find(all.begin(), all.end(), notice) == all.end()) all.push_back(notice);
  }

  /// A result as its schema has it; null if there is none. Throws InputError if it is another one.
  template <class Result>
  Json result(const fs::path& path) const {
    if (!is_there(path)) return {};
    files_.check_holds(path);
    return Json::parse(json_of(read_record<Result>(path)));
  }

  /// A picture for the page; null, with a note, if it cannot be shown.
  Json embedded(const fs::path& picture) {
    try {
      const std::string bytes = files_.content(picture);
      return base64(bytes.data(), bytes.size());
    } catch (const InputError& error) {
      note("A picture is not shown: {}", error.what());
      return nullptr;
    }
  }

  /// What a record names in this folder.
  void check_named(const Json& record, const char* field) const {
    if (const Json name = record.value(field, Json()); name.is_string())
      files_.check_names(name.get<std::string>(), "explain.json", field);
  }

  template <class... Args>
  void note(fmt::format_string<Args...> format, Args&&... args) {
    document_["notes"].push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  fs::path folder_;
  ResultFolder files_;
  std::optional<fs::path> case_file_;
  std::vector<ShownRun> shown_;
  std::map<std::string, std::set<std::string>> recorded_;  ///< what files of a field held when the runs began
  std::vector<std::pair<std::string, fs::path>> dated_;    ///< "The comparison", and its file
  Json document_;
};

}  // namespace

std::string collected(const fs::path& folder) {
  try {
    return Collector(folder).document().dump(-1, ' ', false, Json::error_handler_t::replace);
  } catch (const Json::exception& error) {
    throw input_error("{}: results are not as documented: {}", folder.string(), error.what());
  }
}

}  // namespace tether
