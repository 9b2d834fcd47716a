#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/config/overlay.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/programs.hpp"
#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/explanation/interruption.hpp"
#include "diagnosis/search/diagnosis_report.hpp"
#include "diagnosis/search/diagnosis_text.hpp"
#include "diagnosis/search/further_measurements.hpp"
#include "diagnosis/search/suggested_case.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The runs of a diagnosis: those that identification_master makes of a case that is written for it.
class Runs {
 public:
  Runs(const CommandLine& command, fs::path output) : command_(command), output_(std::move(output)) {}

  /// Makes the runs that CASE asks for, in a folder of its name. Returns runs.json.
  Json make(const fs::path& case_file) {
    CommandLine command = command_;
    command.case_file = case_file;
    command.output = folder_of(case_file);
    command.overwrite = true;
    command.resume = false;
    const int code = run_in_foreground(parallel_run("identification_master", command));
    if (code == exit_input_wrong) throw input_error("the runs of {} are refused (see above)", case_file.string());
    if (code != exit_done)
      throw run_error("the runs of {} failed (see above); the same command goes on from there", case_file.string());
    Json json = Json::parse(content_of(command.output / "runs.json"));
    all += static_cast<int>(json["runs"].size());
    made += json["made"].get<int>();
    cpu_seconds += json["cpu_seconds"].get<double>();
    return json;
  }
  fs::path folder_of(const fs::path& case_file) const { return output_ / case_file.stem(); }

  int all = 0, made = 0;
  double cpu_seconds = 0;

 private:
  const CommandLine& command_;
  fs::path output_;
};

/// From the case to the report.
class Job {
 public:
  Job(const DiagnosedCase& given, const CommandLine& command, fs::path output)
      : given_(given),
        output_(std::move(output)),
        runs_(command, output_),
        effects_(catalogue_of(given.file, given.diagnosis)) {}

  DiagnosisReport run() {
    const fs::path candidates = output_ / "candidates.yaml";
    write_candidates(candidates, given_.file, given_.data, effects_);
    const Json runs = runs_.make(candidates);
    DiagnosisReport report;
    report.cost.sensitivity_runs = runs_.all;
    report.case_name = given_.file.common().name;
    report.title = given_.file.common().title;
    report.alpha = given_.diagnosis.alpha;
    const std::vector<FinishedMotion> motions = stored_runs(runs_.folder_of(candidates));
    runs_known_.insert_or_assign({"[]", "[]"}, motions.front());
    const Evidence evidence(given_.data, given_.lumen, motions.front());
    report.problem = problem_of(given_, evidence, motions, runs.dump(), effects_);
    const DiagnosisCase& d = given_.diagnosis;
    if (d.numerics) add_refined(report.problem, evidence, candidates);
    report.found = search_effects(
        report.problem,
        {d.alpha, d.unexplained, d.enough, d.most, d.refinements, d.confirmed, SearchSettings{}.compared, d.refused},
        [&](const MatrixXd& amplitudes) { return residual_at(report.problem, evidence, amplitudes); });
    report.splits = splits_of(report, evidence, motions);
    if (write_corrected(output_ / "corrected.yaml", given_, report)) report.corrected = "corrected.yaml";
    if (write_suggested(output_ / "suggested.yaml", given_, report, effects_)) report.suggested = "suggested.yaml";
    report.cost.runs = runs_.all;
    report.cost.runs_made = runs_.made;
    report.cost.cpu_seconds = runs_.cpu_seconds;
    return report;
  }

 private:
  void add_refined(EffectProblem& problem, const Evidence& evidence, const fs::path& candidates) {
    for (const RefinedCase& refined : write_refined(candidates, given_)) {
      runs_.make(refined.file);
      const FinishedMotion run = stored_runs(runs_.folder_of(refined.file)).front();
      if (run.failed()) continue;
      const FinishedMotion mapped = on_nodes_of(given_.lumen, lumen_in(refined.file), run);
      add_numerics(problem, refined, problem.residual - residuals_of(evidence, {mapped}, problem.residual).col(0));
    }
  }

  /// Runs of the model with these amplitudes; errors of the data are added to first order, which is exact for most.
  MatrixXd residual_at(const EffectProblem& problem, const Evidence& evidence, const MatrixXd& amplitudes) {
    provide(problem, evidence, amplitudes);
    MatrixXd residuals(problem.residual.size(), amplitudes.cols());
    for (Eigen::Index k = 0; k < amplitudes.cols(); ++k) residuals.col(k) = residual_with(problem, amplitudes.col(k));
    return residuals;
  }

  VectorXd residual_with(const EffectProblem& problem, const VectorXd& amplitudes) const {
    VectorXd residual = known_.at(trial_of(problem, amplitudes));
    for (const Candidate& candidate : problem.candidates)
      if (!candidate.takes_runs())
        residual -= problem.changes(Eigen::all, candidate.amplitudes) * amplitudes(candidate.amplitudes);
    return residual;
  }

  /// What would tell those apart that these data cannot.
  std::vector<Split> splits_of(const DiagnosisReport& report, const Evidence& evidence,
                               std::vector<FinishedMotion> motions) const {
    std::vector<const TestedEffect*> accepted, rivals;
    for (const TestedEffect& effect : report.found.effects)
      if (effect.accepted || effect.rival) (effect.accepted ? accepted : rivals).push_back(&effect);
    std::vector<Rivals> pairs;
    const auto with = [&](const TestedEffect& effect) {
      motions.push_back(runs_known_.at(trial_of(report.problem, effect.run)));
      return static_cast<Eigen::Index>(motions.size()) - 1;
    };
    for (const TestedEffect* rival : rivals)
      for (const TestedEffect* one : accepted)
        if (one->group == rival->group)
          pairs.push_back({residual_with(report.problem, one->run), residual_with(report.problem, rival->run),
                           with(*one), with(*rival)});
    if (pairs.empty()) return {};
    for (FinishedMotion& run : motions)
      if (run.failed()) run = motions.front();  // it changes nothing, as in the search
    const CsvTable table(runs_.folder_of("candidates.yaml") / "runs/base/timeseries.csv");
    return splits(report.problem, pairs, further_measurements(given_, evidence, motions, table.columns()));
  }

  /// Makes the runs among these that no run before was; errors of the data take none.
  void provide(const EffectProblem& problem, const Evidence& evidence, const MatrixXd& amplitudes) {
    known_[{"[]", "[]"}] = problem.residual;
    std::vector<Trial> wanted;
    for (Eigen::Index k = 0; k < amplitudes.cols(); ++k)
      if (const Trial trial = trial_of(problem, amplitudes.col(k));
          !known_.contains(trial) && std::find(wanted.begin(), wanted.end(), trial) == wanted.end())
        wanted.push_back(trial);
    if (wanted.empty()) return;
    const fs::path file = output_ / "trials.yaml";
    write_trials(file, wanted);
    runs_.make(file);
    const std::vector<FinishedMotion> motions = stored_runs(runs_.folder_of(file));
    const MatrixXd residuals = residuals_of(evidence, motions, problem.residual);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      known_[wanted[k]] = residuals.col(static_cast<Eigen::Index>(k));
      runs_known_.insert_or_assign(wanted[k], motions[k]);
    }
  }

  /// Names of the model's numbers and their values, as a case file has them.
  using Trial = std::pair<std::string, std::string>;
  static Trial trial_of(const EffectProblem& problem, const VectorXd& amplitudes) {
    std::vector<std::string> names, values;
    for (const Candidate& candidate : problem.candidates)
      for (const Eigen::Index i : candidate.amplitudes) {
        if (!candidate.takes_runs() || amplitudes(i) == 0) continue;
        const Amplitude& amplitude = problem.amplitudes[static_cast<std::size_t>(i)];
        names.push_back(amplitude.name);
        values.push_back(number_text(amplitude.value(amplitudes(i))));
      }
    return {fmt::format("[{}]", fmt::join(names, ", ")), fmt::format("[{}]", fmt::join(values, ", "))};
  }

  void write_trials(const fs::path& file, const std::vector<Trial>& trials) {
    Overlay overlay{
        output_ / "candidates.yaml", given_.file.common().name + "_trials", {}, {{"diagnosis.runs", "trials"}}};
    for (const auto& [names, values] : trials) {
      const std::string trial = fmt::format("diagnosis.trials.trial_{:03}", ++trials_);
      overlay.values.push_back({trial + ".parameters", names});
      overlay.values.push_back({trial + ".values", values});
    }
    write_overlay(file, overlay);
  }

  const DiagnosedCase& given_;
  fs::path output_;
  Runs runs_;
  std::vector<PlacedEffect> effects_;
  std::map<Trial, VectorXd> known_;  ///< residuals of runs
  std::map<Trial, FinishedMotion> runs_known_;
  int trials_ = 0;
};

std::string where_evidence_is(const fs::path& output, const Diagnosis& diagnosis,
                              const std::vector<std::string>& pictures) {
  std::string text = fmt::format(
      "{} runs, {} of them made now, {:.0f} s of CPU\nIn {}:\n  diagnosis.json     every candidate, what these data "
      "would show, cost\n",
      diagnosis.cost.runs, diagnosis.cost.runs_made, diagnosis.cost.cpu_seconds, output.string());
  if (diagnosis.suggested_case)
    text += fmt::format("  suggested.yaml     the case with the effect: tether identify {}\n",
                        (output / *diagnosis.suggested_case).string());
  if (diagnosis.corrected_case)
    text += fmt::format("  corrected.yaml     the case with corrected data: tether explain {}\n",
                        (output / *diagnosis.corrected_case).string());
  for (const std::string& name : pictures) text += fmt::format("  plots/{}\n", name);
  return text;
}

}  // namespace

Made<Diagnosis> diagnose(const CommandLine& command) {
  say_when_interrupted();
  check_case(command);
  const DiagnosedCase given(command.case_file);
  const fs::path output = fs::absolute(claim_output(command, given.file));
  Diagnosis diagnosis = diagnosis_of(Job(given, command, output).run());
  write_record(output / "diagnosis.json", diagnosis);
  const auto pictures = draw_ranking(diagnosis, output);
  std::string told = text_of(diagnosis) + where_evidence_is(output, diagnosis, pictures);
  return {std::move(diagnosis), std::move(told)};
}

}  // namespace tether
