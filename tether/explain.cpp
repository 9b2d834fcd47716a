#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/output_folder.hpp"
#include "report/report.hpp"
#include "tether/diagnosed_case.hpp"
#include "tether/explained_distances.hpp"
#include "tether/explained_steps.hpp"
#include "tether/finished_run.hpp"
#include "tether/interruption.hpp"
#include "tether/missing_force.hpp"
#include "tether/stored_run.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_json(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw run_error("{}: cannot be read", path.string());
  return Json::parse(file);
}

/// The field as a list of words: "[a, b]".
std::string list_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return "[" + text + "]";
}

/// Numbers that a case identifies.
std::vector<std::string> identified_numbers(const fs::path& case_file) {
  std::vector<std::string> all;
  const YamlNode tree = read_case_tree(case_file);
  const YamlNode* section = tree.find("identification");
  const YamlNode* parameters = section ? section->find("parameters") : nullptr;
  if (parameters == nullptr) return all;
  for (const auto& parameter : parameters->entries)
    if (const YamlNode* of = parameter.value.find("of"))
      for (const YamlNode& number : of->items) all.push_back(number.text);
  return all;
}

/// Of a comparison: which data to look at before any physics, and where and when the model fails.
std::vector<std::string> first_sentences(const Json& comparison) {
  std::size_t unregistered = 0;
  for (const Json& source : comparison["sources"])
    if (const Json& r = source["registration"]; !r.is_null() && r["stands_out"]) ++unregistered;
  std::vector<std::string> all = comparison["sentences"];
  if (all.size() > 1 + unregistered) all.resize(1 + unregistered);
  return all;
}

class Explainer {
 public:
  Explainer(const CommandLine& command, const DiagnosedCase& given, fs::path output)
      : command_(command),
        given_(given),
        output_(std::move(output)),
        steps_(output_, newest_file(given.file), command.quiet) {
    const CommonCase& common = given.file.common();
    explanation_.case_name = common.name;
    explanation_.title = common.title;
    explanation_.case_file = fs::absolute(given.file.path()).lexically_proximate(output_).string();
    explanation_.millimetres = given.file.units().to_mm(1);
    explanation_.unexplained = given.diagnosis.unexplained;
  }

  const Explanation& run() {
    add_first();
    identify_own();
    while (diagnose_best())
      if (add_model() ? is_settled() : !refuse()) break;
    if (verdict_of(explanation_) == "not_in_catalogue") seek_force();
    explanation_.odd_frames = odd_frames(*evidence_, problem_, residuals_.back(), wrong_frames());
    explanation_.steps = steps_.all();
    return explanation_;
  }

 private:
  ExplainedModel& best() { return explanation_.models[explanation_.best]; }
  fs::path case_of(const std::string& name) const { return output_ / (name + ".yaml"); }

  void write_case(const std::string& name, const std::string& title, const std::vector<Overlay::Value>& values) const {
    const CommonCase& common = given_.file.common();
    const std::string& of = common.title.empty() ? common.name : common.title;
    write_overlay(case_of(name), {given_.file.path(), common.name + "_" + name, of + title, values});
  }

  CommandLine command_for(const std::string& name, const std::string& folder) const {
    CommandLine command = command_;
    command.case_file = case_of(name);
    command.output = output_ / folder;
    command.overwrite = true;
    command.resume = false;
    return command;
  }

  void add_first() {
    ExplainedModel model;
    model.name = "as given";
    if (given_.file.has("observer")) model.values.push_back({"observer", ""});  // it would hide what is missing
    simulate_and_compare(model);
    explanation_.failure = first_sentences(read_json(output_ / model.folder() / "comparison.json"));
    first_ = std::make_unique<StoredRun>(output_ / model.folder());
    first_motion_ = first_->motion();
    evidence_ = std::make_unique<Evidence>(given_.data, given_.lumen, first_motion_);
    problem_ = evidence_->problem();
    residuals_.push_back(problem_.residual);
    set_misfit(model, problem_.residual);
    explanation_.models.push_back(model);
  }

  void simulate_and_compare(const ExplainedModel& model) {
    write_case(model.folder(), ", " + model.name, model.values);
    steps_.make(fmt::format("model {}, {}: against the data", model.number, model.name), case_of(model.folder()),
                model.folder(), "comparison.json",
                [&](bool) { return compare(command_for(model.folder(), model.folder())); });
  }

  void set_misfit(ExplainedModel& model, const VectorXd& residual) const {
    model.training = misfit_of(problem_, *evidence_, residual, problem_.training);
    if (!problem_.held_out.empty()) model.held_out = misfit_of(problem_, *evidence_, residual, problem_.held_out);
  }

  /// What the case itself wants to be identified comes first: an effect must show beyond it. Kept if it is better.
  void identify_own() {
    if (identified_numbers(given_.file.path()).empty()) return;
    ExplainedModel model;
    model.number = best().number + 1;
    model.name = "with its own parameters identified";
    model.values = best().values;
    identify_into(model);
    judge(model);
  }

  /// What the best model lacks. False if nothing more is to be added.
  bool diagnose_best() {
    ExplainedModel& model = best();
    const std::string folder = model.diagnosis_folder();
    std::vector<Overlay::Value> values = model.values;
    std::vector<std::string> assumed = given_.diagnosis.assumed;
    for (const std::string& number : identified_numbers(case_of(model.folder()))) assumed.push_back(number);
    for (const auto& value : of_data_) set_value(values, value);
    if (!assumed.empty()) set_value(values, {"diagnosis.assumed", list_text(assumed)});
    if (!model.refused.empty()) set_value(values, {"diagnosis.refused", list_text(model.refused)});
    set_value(values, {"diagnosis.most", "1"});  // one at a time, all refitted in between
    set_value(values, {"diagnosis.enough", number_text(enough())});
    write_case(folder, ", its diagnosis", values);
    steps_.make(fmt::format("model {}: what it lacks", model.number), case_of(folder), folder, "diagnosis.json",
                [&](bool) { return diagnose(command_for(folder, folder)); });
    model.diagnosis = content_of(output_ / folder / "diagnosis.json");
    return effects_added() < given_.diagnosis.most && accepted_effects(model.diagnosis, false) != "[]" &&
           !are_data_to_be_checked();
  }

  /// Whether the last diagnosis says that all frames of a source are off: the user must see to that, and held-out
  /// frames are no judges of what else is missing. One wrong frame is left out.
  bool are_data_to_be_checked() {
    const Json errors = Json::parse(accepted_effects(best().diagnosis, true));
    return std::any_of(errors.begin(), errors.end(),
                       [](const Json& error) { return error["kind"] == "data" && error["frame"].is_null(); });
  }

  /// Whether the last diagnosis foresaw that so little would be left, and the model keeps what it promised.
  bool is_settled() const {
    const auto before = std::find_if(explanation_.models.rend() - static_cast<long>(explanation_.best),
                                     explanation_.models.rend(), [](const auto& model) { return model.accepted; });
    const std::string& diagnosis = before->diagnosis;
    const Json said = Json::parse(diagnosis);
    if (said["more"] || said["verdict"] == "not_in_catalogue") return false;
    const Json foreseen = Json::parse(accepted_effects(diagnosis, false))[0]["held_out_gain"];
    const auto& gain = explanation_.models[explanation_.best].gain;
    return foreseen.is_null() || !gain || gain->value > 0.8 * foreseen["value"].get<double>();
  }

  /// What was not confirmed is not to be accepted again: another may be. False if that was often enough.
  bool refuse() {
    constexpr std::size_t often_enough = 3;
    ExplainedModel& model = best();
    for (const Json& effect : Json::parse(accepted_effects(model.diagnosis, false)))
      for (const Json& parameter : effect["parameters"]) model.refused.push_back(parameter["parameter"]);
    return explanation_.models.size() - 1 - explanation_.best <= often_enough;
  }

  int effects_added() const {
    return static_cast<int>(std::count_if(explanation_.models.begin(), explanation_.models.end(),
                                          [](const auto& model) { return model.accepted && model.added != "[]"; }));
  }

  /// What the first model left beyond noise, times the share that may be left.
  double enough() const {
    const Json first = Json::parse(first_diagnosis(explanation_));
    if (first.is_null() || first["lack_of_fit"]["before"].is_null()) return 0;
    return explanation_.unexplained * first["lack_of_fit"]["before"]["excess"].get<double>();
  }

  /// The best model with what its diagnosis accepted, refitted, run without correction. False if that is no better.
  bool add_model() {
    const Json accepted = Json::parse(accepted_effects(best().diagnosis, false));
    ExplainedModel model;
    model.number = explanation_.models.back().number + 1;
    model.values = best().values;
    model.name = "with";
    for (const Json& effect : accepted)
      model.name += fmt::format("{} {} at {}", model.name == "with" ? "" : " and", effect["name"].get<std::string>(),
                                effect["where"].get<std::string>());
    if (accepted[0]["where"] == "") model.name = "with other " + accepted[0]["name"].get<std::string>();
    for (const auto& value : values_of_overlay(output_ / best().diagnosis_folder() / "suggested.yaml"))
      set_value(value.field.starts_with("observations.") ? of_data_ : model.values, value);
    identify_into(model);
    const Json estimate = read_json(output_ / model.identification_folder() / "estimate.json");
    for (std::size_t i = 1; i <= explanation_.best; ++i)
      if (explanation_.models[i].accepted)
        explanation_.models[i].added = with_estimates(Json::parse(explanation_.models[i].added), estimate);
    model.added = with_estimates(accepted, estimate);
    return judge(model);
  }

  /// Runs a model without correction, and keeps it if it is better than the best before it.
  bool judge(ExplainedModel& model) {
    simulate_and_compare(model);
    const StoredRun run(output_ / model.folder());
    const FinishedMotion motion = run.motion();
    VectorXd residual = evidence_->residuals({&motion}).col(0);
    residual = residual.array().isFinite().select(residual, problem_.residual);
    set_misfit(model, residual);
    model.gain = gain_between(problem_, residuals_.back(), residual);
    model.reason = objection(model, residual);
    model.accepted = model.reason.empty();
    explanation_.models.push_back(model);
    if (!model.accepted) return false;
    explanation_.best = explanation_.models.size() - 1;
    residuals_.push_back(residual);
    explanation_.held_out = gain_between(problem_, residuals_.front(), residual);
    return true;
  }

  /// Why the model is no better than the one before it; empty if it is.
  std::string objection(const ExplainedModel& model, const VectorXd& residual) const {
    if (model.gain && !(model.gain->lower > 0)) return "held-out frames do not confirm it";
    const auto square = [&](const VectorXd& r) {
      const VectorXd rows = r(problem_.training);
      return rows.dot(problem_.precision(problem_.training).cwiseProduct(rows));
    };
    return square(residual) < square(residuals_.back()) ? "" : "the misfit does not fall";
  }

  /// Finds the parameters of all that was added and of the case itself, together; they become the model's values.
  void identify_into(ExplainedModel& model) {
    const std::string folder = model.identification_folder();
    std::vector<Overlay::Value> values = model.values;
    for (const auto& value : of_data_) set_value(values, value);
    write_case(folder, ", to be identified", values);
    steps_.make(fmt::format("model {}, {}: its parameters", model.number, model.name), case_of(folder), folder,
                "estimate.json", [&](bool was_begun) {
                  CommandLine command = command_for(folder, folder);
                  command.resume = was_begun && fs::exists(output_ / folder / "checkpoint");
                  return identify(command);
                });
    for (const auto& value : values_of_overlay(output_ / folder / "identified.yaml")) set_value(model.values, value);
    model.identified = true;
  }

  /// Amplitudes as the filter found them.
  static std::string with_estimates(Json effects, const Json& estimate) {
    for (Json& effect : effects) {
      take_estimate(effect["amplitude"], estimate);
      for (Json& parameter : effect["parameters"]) take_estimate(parameter, estimate);
    }
    return effects.dump();
  }
  static void take_estimate(Json& amplitude, const Json& estimate) {
    for (const Json& parameter : estimate["parameters"])
      for (const Json& set : parameter["sets"])
        if (set["name"] == amplitude["parameter"]) {
          const Json& found = parameter["estimate"];
          amplitude["value"] = set["value"];
          amplitude["lower"] = found["lower_95"];
          amplitude["upper"] = found["upper_95"];
        }
  }

  /// Places in time of single frames that diagnoses found wrong.
  std::vector<std::string> wrong_frames() const {
    std::vector<std::string> all;
    for (const ExplainedModel& model : explanation_.models)
      if (model.diagnosis != "null")
        for (const Json& error : Json::parse(accepted_effects(model.diagnosis, true))) all.push_back(error["where"]);
    return all;
  }

  void seek_force() {
    MissingForce force(given_, best().values, output_ / "force");
    write_case("force_walk", ", with tractions that walk at random", force.identification());
    steps_.make("a force without a law: a traction in each region, over time", case_of("force_walk"), "force/walk",
                "estimate.json", [&](bool was_begun) {
                  CommandLine command = command_for("force_walk", "force/walk");
                  command.resume = was_begun && fs::exists(output_ / "force/walk/checkpoint");
                  return identify(command);
                });
    write_case("force_run", ", with these tractions", force.with_tractions());
    steps_.make("the model with these tractions", case_of("force_run"), "force/run", "comparison.json",
                [&](bool) { return compare(command_for("force_run", "force/run")); });
    explanation_.force = force.laws();
    std::ofstream(output_ / "force/force.json") << explanation_.force << std::endl;
  }

  const CommandLine& command_;
  const DiagnosedCase& given_;
  fs::path output_;
  ExplainedSteps steps_;
  Explanation explanation_;
  std::unique_ptr<StoredRun> first_;
  FinishedMotion first_motion_;
  std::unique_ptr<Evidence> evidence_;
  EffectProblem problem_;
  std::vector<VectorXd> residuals_;      ///< of the accepted models
  std::vector<Overlay::Value> of_data_;  ///< frames that are left out where values are found; all are compared
};

std::string line_of(const ExplainedModel& model, double millimetres) {
  const auto text = [&](const std::optional<Misfit>& misfit) {
    return misfit ? fmt::format("{:.2f} ({:.1f})", millimetres * misfit->length, misfit->in_noise) : std::string("-");
  };
  return fmt::format("  {:<48} {:>12} {:>12}{}\n", fmt::format("{} {}", model.number, model.name), text(model.training),
                     text(model.held_out), model.accepted ? "" : "  not kept");
}

std::string text_of(const Explanation& explanation, const fs::path& output) {
  std::string text = "\n";
  for (const std::string& sentence : sentences_of(explanation)) text += sentence + "\n";
  text += fmt::format("\n  {:<48} {:>12} {:>12}\n", "model: distance in mm (in the noise)", "training", "held out");
  for (const ExplainedModel& model : explanation.models) text += line_of(model, explanation.millimetres);
  text += fmt::format("\nIn {}:\n  explain.json       the whole path\n", output.string());
  if (explanation.best > 0)
    text += fmt::format("  {}.yaml       the case with what was found, ready for tether simulate\n",
                        explanation.models[explanation.best].folder());
  if (const std::string corrected = corrected_case(explanation); !corrected.empty())
    text += fmt::format("  {}   the case with corrected data\n", corrected);
  return text;
}

}  // namespace

int explain(const CommandLine& command) {
  say_when_interrupted();
  check_case(command);
  const DiagnosedCase given(command.case_file);
  CommandLine own = command;
  if (own.output.empty()) own.output = fs::path("out") / (given.file.common().name + "_explain");
  const fs::path output = fs::absolute(claim_output(own, given.file));
  Explainer explainer(own, given, output);
  const Explanation& explanation = explainer.run();
  write_json(output / "explain.json", explanation);
  const fs::path page = write_report(output);
  if (!command.quiet)
    std::cout << text_of(explanation, own.output)
              << "  report.html        all of it, to look at and to mail: " << page.string() << "\n";
  return exit_done;
}

}  // namespace tether
