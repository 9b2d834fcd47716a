#include "diagnosis/explanation/explainer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/config/files_to_go_on_with.hpp"
#include "common/config/identified_parameters.hpp"
#include "common/config/named_path.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/comparison/finished_run.hpp"
#include "diagnosis/evidence/stored_run.hpp"
#include "diagnosis/explanation/explained_distances.hpp"
#include "diagnosis/explanation/explained_steps.hpp"
#include "diagnosis/explanation/missing_force.hpp"
#include "diagnosis/results/comparison.hpp"
#include "identification_master/results/estimate.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// The field as a list of words: "[a, b]".
std::string list_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return "[" + text + "]";
}

/// Numbers that a case identifies.
std::vector<std::string> identified_numbers(const fs::path& case_file) {
  std::vector<std::string> all;
  for (const IdentifiedParameter& parameter : identified_parameters(case_file))
    all.insert(all.end(), parameter.of.begin(), parameter.of.end());
  return all;
}

std::uint64_t hash_of(const DiagnosisSettings& settings) {
  std::uint64_t hash = hash_bytes(&settings.enough, sizeof settings.enough);
  for (const std::string& number : settings.refused) hash = hash_values(number, hash);
  return hash;
}

/// "with contact at spine and ...", "with other inputs".
std::string name_with(const std::vector<Finding>& accepted) {
  if (accepted.front().where.empty()) return "with other " + accepted.front().name;
  std::string name = "with";
  for (const Finding& finding : accepted)
    name += fmt::format("{} {} at {}", &finding == &accepted.front() ? "" : " and", finding.name, finding.where);
  return name;
}

void take_estimate(FoundAmplitude& amplitude, const Estimate& estimate) {
  for (const EstimatedParameter& parameter : estimate.parameters)
    for (const EstimatedNumber& number : parameter.sets)
      if (number.name == amplitude.parameter) {
        amplitude.value = number.value;
        amplitude.lower = parameter.estimate.lower;
        amplitude.upper = parameter.estimate.upper;
      }
}

/// Amplitudes as the filter found them.
void take_estimates(std::vector<Finding>& findings, const Estimate& estimate) {
  for (Finding& finding : findings) {
    take_estimate(finding.amplitude, estimate);
    for (FoundAmplitude& amplitude : finding.parameters) take_estimate(amplitude, estimate);
  }
}

class Explainer {
 public:
  Explainer(const DiagnosedCase& given, fs::path output, ExplanationWork& work, bool quiet)
      : given_(given), output_(std::move(output)), work_(work), steps_(output_, given.inputs, quiet) {
    const CommonCase& common = given.file.common();
    path_.case_name = common.name;
    path_.title = common.title;
    path_.case_file = name_for(given.file.path(), output_);
    path_.millimetres = given.file.units().to_mm(1);
    path_.unexplained = given.diagnosis.unexplained;
  }

  ExplanationPath run() {
    add_first();
    identify_own();
    while (diagnose_best())
      if (add_model() ? is_settled(path_) : !refuse()) break;
    if (verdict_of(path_) == Verdict::not_in_catalogue && has_catalogue("solid", given_.file)) seek_force();
    path_.odd_frames = odd_frames(*evidence_, problem_, residuals_.back(), wrong_frames());
    path_.steps = steps_.all();
    return std::move(path_);
  }

 private:
  PathModel& best() { return path_.models[path_.best]; }
  fs::path case_of(const std::string& name) const { return output_ / (name + ".yaml"); }

  Overlay overlay(const std::string& name, const std::string& title, const std::vector<Overlay::Value>& values) const {
    const CommonCase& common = given_.file.common();
    return {given_.file.path(), common.name + "_" + name, common.titled(title), values};
  }
  void write_case(const std::string& name, const std::string& title, const std::vector<Overlay::Value>& values) const {
    write_overlay(case_of(name), overlay(name, title, values));
  }
  /// A person may go on with it.
  void write_model(const PathModel& model) const {
    const std::string name = model.folder();
    make_to_go_on_with(output_, name + ".yaml", [&](const fs::path& file) {
      write_overlay(file, overlay(name, ", " + model.told.name, model.values));
    });
  }

  ExplanationTask task(const std::string& name, const std::string& folder, bool was_begun = false) const {
    return {case_of(name), output_ / folder, was_begun && fs::exists(output_ / folder / "checkpoint")};
  }

  void add_first() {
    PathModel model;
    model.told.name = "as given";
    if (given_.file.has("observer")) model.values.push_back({"observer", ""});  // it would hide what is missing
    simulate_and_compare(model);
    path_.failure = read_record<ComparisonResult>(output_ / model.folder() / "comparison.json").first_look;
    first_ = std::make_unique<StoredRun>(output_ / model.folder());
    first_motion_ = first_->motion();
    evidence_ = std::make_unique<Evidence>(given_.data, given_.lumen, first_motion_);
    problem_ = evidence_->problem();
    residuals_.push_back(problem_.residual);
    set_misfit(model, problem_.residual);
    path_.models.push_back(model);
  }

  void simulate_and_compare(const PathModel& model) {
    write_model(model);
    const fs::path compared = output_ / model.folder() / "comparison.json";
    if (fs::exists(compared) && damage_of(output_ / model.folder())) fs::remove(compared);  // the step is made again
    steps_.make(fmt::format("model {}, {}: against the data", model.told.number, model.told.name),
                case_of(model.folder()), model.folder(), "comparison.json",
                [&](bool was_begun) { return work_.compare(task(model.folder(), model.folder(), was_begun)); });
    check_unchanged(output_, "explain", {model.folder() + ".yaml"});  // the run read it after it was made
  }

  void set_misfit(PathModel& model, const VectorXd& residual) const {
    model.told.training = misfit_of(problem_, *evidence_, residual, problem_.training);
    model.told.held_out = misfit_of(problem_, *evidence_, residual, problem_.held_out);
  }

  /// What the case itself wants to be identified comes first: an effect must show beyond it. Kept if it is better.
  void identify_own() {
    if (identified_numbers(given_.file.path()).empty()) return;
    PathModel model;
    model.told.number = best().told.number + 1;
    model.told.name = "with its own parameters identified";
    model.values = best().values;
    identify_into(model);
    judge(model);
  }

  /// What the best model lacks. False if nothing more is to be added.
  bool diagnose_best() {
    ask();
    if (static_cast<int>(accepted_of(*best().diagnosis, false).size()) < best().at_once && best().at_once > 1) {
      ask_for_one(path_);
      ask();
    }
    return effects_added() < given_.diagnosis.most && !accepted_of(*best().diagnosis, false).empty() &&
           !are_data_to_be_checked();
  }

  /// Diagnoses the best model.
  void ask() {
    PathModel& model = best();
    ++model.asked;
    const std::string folder = model.diagnosis_folder();
    std::vector<Overlay::Value> values = model.values;
    std::vector<std::string> assumed = given_.diagnosis.assumed;
    for (const std::string& number : identified_numbers(case_of(model.folder()))) assumed.push_back(number);
    for (const auto& value : of_data_) set_value(values, value);
    if (!assumed.empty()) set_value(values, {"diagnosis.assumed", list_text(assumed)});
    set_value(values, {"diagnosis.most", std::to_string(model.at_once)});  // all are refitted before the next
    write_case(folder, ", its diagnosis", values);
    const DiagnosisSettings settings{model.refused, enough()};
    steps_.make(
        fmt::format("model {}: what it lacks", model.told.number), case_of(folder), folder, "diagnosis.json",
        [&](bool) { return work_.diagnose(task(folder, folder), settings); }, hash_of(settings));
    model.diagnosis = read_record<Diagnosis>(output_ / folder / "diagnosis.json");
  }

  /// Whether the last diagnosis says that all frames of a source are off: the user must see to that, and held-out
  /// frames are no judges of what else is missing. One wrong frame is left out.
  bool are_data_to_be_checked() {
    const std::vector<Finding> errors = accepted_of(*best().diagnosis, true);
    return std::any_of(errors.begin(), errors.end(),
                       [](const Finding& error) { return error.kind == CandidateKind::data && !error.frame; });
  }

  /// What was not confirmed is not to be accepted again: another may be. False if that was often enough.
  bool refuse() {
    constexpr std::size_t often_enough = 3;
    ask_otherwise(path_, given_.diagnosis.most - effects_added());
    return path_.refused_since_best() <= often_enough;
  }

  int effects_added() const {
    std::size_t count = 0;
    for (const PathModel& model : path_.models)
      if (model.told.accepted) count += model.told.added.size();
    return static_cast<int>(count);
  }

  /// What the first model left beyond noise, times the share that may be left.
  double enough() const {
    const Diagnosis* first = first_diagnosis(path_);
    return first && first->lack_of_fit.before ? path_.unexplained * first->lack_of_fit.before->excess : 0;
  }

  /// The best model with what its diagnosis accepted, refitted, run without correction. False if that is no better.
  bool add_model() {
    const std::vector<Finding> accepted = accepted_of(*best().diagnosis, false);
    PathModel model;
    model.told.number = path_.models.back().told.number + 1;
    model.values = best().values;
    model.told.name = name_with(accepted);
    const fs::path diagnosis = output_ / best().diagnosis_folder();
    check_unchanged(diagnosis, "diagnose", {suggested_file});
    for (const auto& value : values_of_overlay(diagnosis / suggested_file))
      set_value(value.field.starts_with("observations.") ? of_data_ : model.values, value);
    identify_into(model);
    const auto estimate = read_record<Estimate>(output_ / model.identification_folder() / "estimate.json");
    for (std::size_t i = 1; i <= path_.best; ++i)
      if (path_.models[i].told.accepted) take_estimates(path_.models[i].told.added, estimate);
    model.told.added = accepted;
    take_estimates(model.told.added, estimate);
    return judge(model);
  }

  /// Runs a model without correction, and keeps it if it is better than the best before it.
  bool judge(PathModel& model) {
    simulate_and_compare(model);
    const StoredRun run(output_ / model.folder());
    const FinishedMotion motion = run.motion();
    VectorXd residual = evidence_->residuals({&motion}).col(0);
    residual = residual.array().isFinite().select(residual, problem_.residual);
    set_misfit(model, residual);
    model.told.gain = gain_between(problem_, residuals_.back(), residual);
    model.told.objection = objection(model, residual);
    model.told.accepted = !model.told.objection;
    path_.models.push_back(model);
    if (!model.told.accepted) return false;
    path_.best = path_.models.size() - 1;
    residuals_.push_back(residual);
    path_.held_out = gain_between(problem_, residuals_.front(), residual);
    return true;
  }

  /// Why the model is no better than the one before it; none if it is.
  std::optional<Objection> objection(const PathModel& model, const VectorXd& residual) const {
    if (model.told.gain && !(model.told.gain->lower > 0)) return Objection::not_confirmed;
    const auto square = [&](const VectorXd& r) {
      const VectorXd rows = r(problem_.training);
      return rows.dot(problem_.precision(problem_.training).cwiseProduct(rows));
    };
    if (square(residual) < square(residuals_.back())) return std::nullopt;
    return Objection::misfit_stays;
  }

  /// Finds the parameters of all that was added and of the case itself, together; they become the model's values.
  void identify_into(PathModel& model) {
    const std::string folder = model.identification_folder();
    std::vector<Overlay::Value> values = model.values;
    for (const auto& value : of_data_) set_value(values, value);
    write_case(folder, ", to be identified", values);
    steps_.make(fmt::format("model {}, {}: its parameters", model.told.number, model.told.name), case_of(folder),
                folder, "estimate.json",
                [&](bool was_begun) { return work_.identify(task(folder, folder, was_begun)); });
    check_unchanged(output_ / folder, "identify", {identified_file});
    for (const auto& value : values_of_overlay(output_ / folder / identified_file)) set_value(model.values, value);
    model.told.identification = folder;
  }

  /// Single frames that diagnoses found wrong.
  std::vector<FrameOfSource> wrong_frames() const {
    std::vector<FrameOfSource> all;
    for (const PathModel& model : path_.models)
      if (model.diagnosis)
        for (const Finding& error : accepted_of(*model.diagnosis, true))
          if (error.source && error.frame) all.emplace_back(*error.source, *error.frame);
    return all;
  }

  void seek_force() {
    MissingForce force(given_, best().values, output_ / "force");
    write_case("force_walk", ", with tractions that walk at random", force.identification());
    steps_.make("a force without a law: a traction in each region, over time", case_of("force_walk"), "force/walk",
                "estimate.json",
                [&](bool was_begun) { return work_.identify(task("force_walk", "force/walk", was_begun)); });
    write_case("force_run", ", with these tractions", force.with_tractions());
    steps_.make("the model with these tractions", case_of("force_run"), "force/run", "comparison.json",
                [&](bool was_begun) { return work_.compare(task("force_run", "force/run", was_begun)); });
    path_.force = force.laws();
    write_record(output_ / "force/force.json", *path_.force);
  }

  const DiagnosedCase& given_;
  fs::path output_;
  ExplanationWork& work_;
  ExplainedSteps steps_;
  ExplanationPath path_;
  std::unique_ptr<StoredRun> first_;
  FinishedMotion first_motion_;
  std::unique_ptr<Evidence> evidence_;
  EffectProblem problem_;
  std::vector<VectorXd> residuals_;      ///< of the accepted models
  std::vector<Overlay::Value> of_data_;  ///< frames that are left out where values are found; all are compared
};

}  // namespace

ExplanationPath explain(const DiagnosedCase& given, const fs::path& output, ExplanationWork& work, bool quiet) {
  return Explainer(given, output, work, quiet).run();
}

}  // namespace tether
